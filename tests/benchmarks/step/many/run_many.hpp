// Many axes in one process: the same engines and the same steps, with the processor's vector unit finding the steps.
#pragma once

#include <span>

#include "core/step/engine.hpp"
#include "tests/benchmarks/step/many/edge_buffer.hpp"

namespace lockstep {

/// Runs one axis to `until` or to the end of its piece, as StepEngine::run does, and appends its steps to `edges`.
/// If the buffer has no room for the steps of a whole stretch, the axis stops before it; now() is then the tick it has
/// reached.
void run_into(StepEngine& axis, Tick until, EdgeBuffer& edges);

/// run_into for every axis, axes[i] into edges[i]. Both have the same size.
void run_many(std::span<StepEngine> axes, Tick until, std::span<EdgeBuffer> edges);

}  // namespace lockstep
