// What a step costs where one process moves many axes, in windows of a frame.
#include <vector>

#include "core/step/engine.hpp"
#include "tests/benchmarks/step/measure.hpp"
#include "tests/benchmarks/step/moves.hpp"
#include "tests/benchmarks/step/player.hpp"

namespace lockstep::bench {
namespace {

constexpr Ticks kFrame{5'000};

template <typename Engine>
std::vector<Player<Engine>> players(const Limits& limits, int axes) {
    std::vector<Player<Engine>> all;
    for (int axis = 0; axis < axes; ++axis) { all.emplace_back(pieces_of_axis(limits, axis), rest_position(0, false)); }
    return all;
}

/// Runs every axis frame by frame to the end of its pieces. Returns the ticks of all axes.
template <typename Engine, typename Run>
double play_all(std::vector<Player<Engine>>& axes, Run&& run) {
    double ticks = 0;
    Tick until;
    for (bool moving = true; moving;) {
        until += kFrame;
        moving = false;
        for (Player<Engine>& axis : axes) {
            axis.play(until, run);
            moving = moving || !axis.done();
        }
        ticks += static_cast<double>(kFrame.value) * static_cast<double>(axes.size());
    }
    return ticks;
}

void step_scalar(benchmark::State& state, const Limits& limits, int axes) {
    Times times;
    double ticks = 0;
    for (auto _ : state) {
        auto all = players<StepEngine>(limits, axes);
        ticks = play_all(all, [&](StepEngine& engine, Tick until) {
            engine.run(until, [&](StepEdge edge) { times(edge.tick.value); });
        });
        benchmark::DoNotOptimize(times);
    }
    report_cost(state, static_cast<double>(limits.steps * axes), ticks);
}

BENCHMARK_CAPTURE(step_scalar, M1_8_axes, kM1, 8)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(step_scalar, M2_8_axes, kM2, 8)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(step_scalar, M3_8_axes, kM3, 8)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lockstep::bench
