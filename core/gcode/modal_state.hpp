// What holds at a line of a G-code program by the lines before it: what a program that goes on there takes up.
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
    std::vector<double> offset_mm;      // where each axis's own 0 is, machine coordinates
};

/// As the text leaves it at the end of the line before `line`. Lines that are wrong are passed over.
ModalState modal_state_at(std::string_view text, const GcodeSetup& setup, int line);

}  // namespace lockstep
