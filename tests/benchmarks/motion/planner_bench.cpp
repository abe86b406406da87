// The cost of planning: a single move, a move within a long path, and a frame of all axes with its tail.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "core/coordinator/path/epoch_runner.hpp"
#include "core/motion/interpolate.hpp"
#include "core/motion/lookahead.hpp"

namespace lockstep {
namespace {

struct Axes {
    std::vector<AxisLimits> limits;
    std::vector<double> steps_per_mm;
};

Axes mill(std::size_t n) {
    return {std::vector<AxisLimits>(n, {.start_velocity = 800e-6,
                                        .max_velocity = 12'000e-6,
                                        .max_acceleration = 120'000e-12,
                                        .max_deceleration = 100'000e-12}),
            std::vector<double>(n, 80)};
}

/// A polyline of short segments, like an arc.
std::vector<PathMove> polyline(const Axes& axes, std::size_t count) {
    std::vector<PathMove> moves;
    AxisCounts at;
    for (std::size_t i = 0; i < axes.limits.size(); ++i) { (void)at.push_back(0); }
    for (std::size_t k = 0; k < count; ++k) {
        AxisCounts to = at;
        for (std::size_t i = 0; i < axes.limits.size(); ++i) {
            to[i] += std::llround(60 * std::sin(0.05 * static_cast<double>(k) + static_cast<double>(i))) + 1;
        }
        moves.push_back(make_move(at, to, axes.limits, axes.steps_per_mm, 50e-6));
        at = to;
    }
    return moves;
}

constexpr PathBounds kBounds{Ticks{3'000}, 28};

void PlanOneMove(benchmark::State& state) {
    const Axes axes = mill(3);
    const auto moves = polyline(axes, 1);
    for (auto _ : state) { benchmark::DoNotOptimize(plan_path(moves, {}, axes.limits, kBounds)); }
}
BENCHMARK(PlanOneMove)->Name("plan/one_move_3_axes");

void PlanPath(benchmark::State& state) {
    const Axes axes = mill(static_cast<std::size_t>(state.range(0)));
    const auto moves = polyline(axes, 10'000);
    for (auto _ : state) { benchmark::DoNotOptimize(plan_path(moves, {}, axes.limits, kBounds)); }
    state.counters["time_per_move"] = benchmark::Counter(static_cast<double>(state.iterations()) * 1e4,
                                                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(PlanPath)->Name("plan/path_of_10000_moves")->Arg(3)->Arg(6)->Unit(benchmark::kMillisecond);

void InterpolatePath(benchmark::State& state) {
    const Axes axes = mill(3);
    const Path path = plan_path(polyline(axes, 1'000), {}, axes.limits, kBounds);
    std::vector<Piece> pieces(3);
    std::int64_t made = 0;
    for (auto _ : state) {
        std::vector<Position> at(3);
        PieceSource source(path, Ticks{0}, path.duration().ceil(), at);
        while (source.next(pieces)) { made += 3; }
        benchmark::DoNotOptimize(at);
    }
    state.counters["time_per_piece"] =
        benchmark::Counter(static_cast<double>(made), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(InterpolatePath)->Name("plan/pieces")->Unit(benchmark::kMicrosecond);

void BrakeFromAnywhere(benchmark::State& state) {
    const Axes axes = mill(3);
    const Path path = plan_path(polyline(axes, 1'000), {}, axes.limits, kBounds);
    const std::int64_t whole = path.duration().value;
    std::int64_t t = 0;
    for (auto _ : state) {
        t = (t + whole / 7 + 12'345) % whole;
        benchmark::DoNotOptimize(brake_from(path, Subticks{t}, axes.limits));
    }
}
BENCHMARK(BrakeFromAnywhere)->Name("plan/tail");

}  // namespace
}  // namespace lockstep
