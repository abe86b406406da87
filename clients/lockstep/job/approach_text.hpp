// Writes an approach, and the modal state at its end, as text and as a report.
#pragma once

#include <string>
#include <vector>

#include "clients/lockstep/job/approach.hpp"
#include "core/gcode/modal_state.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// A line for each move: its target, length and speed.
std::string approach_text(const Program& program, const std::vector<ApproachMove>& moves);

/// "  takes up G21 G90 F1200.0, no offset".
std::string modal_text(const MachineConfig& machine, const ModalState& modal);

void fill_approach(const Program& program, const std::vector<ApproachMove>& moves, proto::RunReport& report);

}  // namespace lockstep
