// The rest of a program from a line on, for a machine at another position.
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
    int from_line = 0;      // 0: the whole program
    std::string lift;       // the axes that leave the work first; empty: those that home first
    bool straight = false;  // in one line instead
};

struct Rest {
    Program program;  // the approach, and the rest
    std::vector<ApproachMove> approach;
    ModalState modal;
};

/// `modal`: before that line.
std::expected<Rest, std::string> rest_of(const Program& program, ModalState modal, const RestartOptions& options,
                                         const MachineConfig& machine, const std::vector<double>& stands_mm);
/// `program` is `text` read with `setup`. Error: nothing is left, or the approach is unknown.
std::expected<Rest, std::string> rest_of(const Program& program, std::string_view text, const GcodeSetup& setup,
                                         const RestartOptions& options, const MachineConfig& machine,
                                         const std::vector<double>& stands_mm);

}  // namespace lockstep
