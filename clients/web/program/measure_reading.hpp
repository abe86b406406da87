// Makes the program of a measurement ready to run, as `lockstep probe` does.
#pragma once

#include "clients/web/program/program_reading.hpp"

namespace lockstep::web {

/// Fails with 422 for what the machine cannot measure from there, with the place in the order.
std::expected<ReadyProgram, Problem> ready_measurement(const MeasureOrder& order, const MachineSetup& machine,
                                                       const ProgramStart& start);

}  // namespace lockstep::web
