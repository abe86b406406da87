// The rest of a program from a given line, for a machine at another position.
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
    int from_line = 0;      // 0 for the whole program
    std::string lift;       // the axes that leave the work first; see lifts_of()
    bool straight = false;  // approach in one line instead
};

struct Rest {
    Program program;  // the approach and the rest
    std::vector<ApproachMove> approach;
    ModalState modal;
};

/// `modal`: the modal state before that line.
std::expected<Rest, std::string> rest_of(const Program& program, ModalState modal, const RestartOptions& options,
                                         const MachineConfig& machine, const std::vector<double>& stands_mm);
/// `program` is `text` read with `setup`. Fails if nothing is left, or if the approach is unknown.
std::expected<Rest, std::string> rest_of(const Program& program, std::string_view text, const GcodeSetup& setup,
                                         const RestartOptions& options, const MachineConfig& machine,
                                         const std::vector<double>& stands_mm);

}  // namespace lockstep
