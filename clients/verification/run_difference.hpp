// Where a run is not the one planned.
#pragma once

#include <optional>
#include <string>

#include "clients/analysis/run.hpp"

namespace lockstep::verification {

using analysis::Run;
using analysis::StepMaker;

struct RunDifference {
    std::string text;                   // "starts at tick 12, planned at tick 10"
    std::optional<Tick> tick_expected;  // of the first step that differs, or of the start
    std::optional<Tick> tick_seen;
};

/// By start, position and pieces; none where they are the same.
std::optional<RunDifference> compare_runs(const Run& planned, const Run& seen);

}  // namespace lockstep::verification
