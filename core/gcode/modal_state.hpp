// The modes at a line of a G-code program, as set by the lines before it. A program that continues there needs them.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/gcode/gcode.hpp"

namespace lockstep {

struct ModalState {
    bool inches = false;                // G20
    bool relative = false;              // G91
    std::optional<double> feed_mm_min;  // none: no F yet
    std::vector<double> offset_mm;      // place of each axis's program zero, machine coordinates
};

/// The modes at the end of the line before `line`. Skips lines with errors.
ModalState modal_state_at(std::string_view text, const GcodeSetup& setup, int line);

}  // namespace lockstep
