#include "core/step/many/run_many.hpp"

#include "core/step/many/vector_walk.hpp"

namespace lockstep {
namespace {

/// Below this many steps a vector is not worth its start.
constexpr std::size_t kFewSteps = 5;

/// Roots in vectors; but at constant speed, or for a few steps, nothing is cheaper than one at a time.
void write_steps(const Stretch& stretch, std::size_t steps, Tick start, std::int64_t* out) {
    const auto write = [&](std::int64_t n) {
        *out++ = EdgeBuffer::pack(start + Ticks{n}, stretch.backward);
        return true;
    };
    if (stretch.acceleration == 0) {
        walk_cruise(stretch, write);
    } else if (steps < kFewSteps) {
        walk_roots(stretch, write);
    } else {
        vector_walk(stretch, steps, start, out);
    }
}

}  // namespace

void run_into(StepEngine& axis, Tick until, EdgeBuffer& edges) {
    axis.run_stretches(until, kNeverFast, [&](const Stretch& stretch, Tick start) {
        const std::span<std::int64_t> room = edges.free();
        const auto steps = static_cast<std::size_t>(stretch.steps_in(stretch.ticks));
        if (steps > room.size()) { return Walked{0, false}; }
        if (steps > 0) { write_steps(stretch, steps, start, room.data()); }
        edges.filled(steps);
        return Walked{stretch.ticks, true};
    });
}

void run_many(std::span<StepEngine> axes, Tick until, std::span<EdgeBuffer> edges) {
    for (std::size_t i = 0; i < axes.size(); ++i) { run_into(axes[i], until, edges[i]); }
}

}  // namespace lockstep
