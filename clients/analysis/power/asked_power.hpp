// The power that the words of a program ask for along its path: at the feed where the output follows the speed.
#pragma once

#include "clients/analysis/power/power_grid.hpp"
#include "core/outputs/output_config.hpp"
#include "services/record/reading/recorded_program.hpp"

namespace lockstep::analysis {

/// Adds to `grid` what a program asks for in the plane of its axes X and Y. In rapid moves and rests no energy is asked
/// for, because their time is not. Nothing if the program lacks one of the axes.
void add_asked_power(const RecordedProgram& program, const OutputConfig& output, PowerGrid& grid);

}  // namespace lockstep::analysis
