#include "tests/benchmarks/step/many/run_many.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/benchmarks/step/many/run_many.cpp"
#include <hwy/foreach_target.h>
// The include above compiles this file again for each instruction set; each pass includes highway.h once.
#include <hwy/highway.h>

#include "tests/benchmarks/step/many/vector_walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockstep::HWY_NAMESPACE {

HWY_ATTR void run_axis(StepEngine& axis, Tick until, EdgeBuffer& edges) {
    while (axis.now() < until && !axis.idle()) {
        const Stretch stretch = axis.next(until, kNeverFast);
        const Int128 travel = stretch.travel(stretch.ticks);
        const auto steps = static_cast<std::size_t>(stretch.steps_over(travel));
        const std::span<std::int64_t> room = edges.free();
        if (steps > room.size()) { return; }
        if (steps > 0) { vector_walk(stretch, steps, axis.now(), room.data()); }
        edges.filled(steps);
        axis.pass(stretch, stretch.ticks, travel);
    }
}

}  // namespace lockstep::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockstep {

HWY_EXPORT(run_axis);

void run_into(StepEngine& axis, Tick until, EdgeBuffer& edges) { HWY_DYNAMIC_DISPATCH(run_axis)(axis, until, edges); }

void run_many(std::span<StepEngine> axes, Tick until, std::span<EdgeBuffer> edges) {
    for (std::size_t i = 0; i < axes.size(); ++i) { run_into(axes[i], until, edges[i]); }
}

}  // namespace lockstep
#endif
