// Compares a run with its plan.
#pragma once

#include <optional>
#include <string>

#include "services/record/reading/run.hpp"

namespace lockstep::verification {

using analysis::Run;
using analysis::StepMaker;

struct RunDifference {
    std::string text;                   // "starts at tick 12, planned at tick 10"
    std::optional<Tick> tick_expected;  // of the first step that differs, or of the start
    std::optional<Tick> tick_seen;
};

/// Compares start, position and pieces. Returns nullopt if they are equal.
std::optional<RunDifference> compare_runs(const Run& planned, const Run& seen);

/// How much longer or shorter a run may be by the device's own clock: the slew of machine time, and the
/// rates of clocks, with some reserve.
inline constexpr double kMostStretch = 2e-3;

/// For a device with its own clock, which executes `planned` retimed (core/axis/device/retime.hpp). The run must be
/// commanded for exactly the planned times. At the end of each piece its place must be the planned one within half a
/// tick, at both ends of the run bit for bit. The clocks must explain its length. `joins`: when the run before it
/// ended, by the same clock.
std::optional<RunDifference> compare_retimed(const Run& planned, const Run& seen, std::optional<Tick> joins);

}  // namespace lockstep::verification
