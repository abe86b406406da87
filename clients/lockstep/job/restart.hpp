// What is left of a program from a line, for a machine that stands elsewhere.
#pragma once

#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "clients/lockstep/job/approach.hpp"
#include "core/gcode/gcode.hpp"
#include "core/gcode/modal_state.hpp"

namespace lockstep {

struct RestartOptions {
    int from_line = 0;      // 0: all of it
    std::string lift;       // which axes leave the work first; empty: those that home first
    bool straight = false;  // in one line instead
};

struct Rest {
    Program program;  // the approach, and what is left
    std::vector<ApproachMove> approach;
    ModalState modal;
};

/// `program` is `text` read with `setup`. Error: nothing is left, or how to come there is not known.
std::expected<Rest, std::string> rest_of(const Program& program, std::string_view text, const GcodeSetup& setup,
                                         const RestartOptions& options, const MachineConfig& machine,
                                         const std::vector<double>& stands_mm);

}  // namespace lockstep
