// The cost of a step of one axis in each form, and its distance from the ideal time.
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/step/engine.hpp"
#include "core/step/tick_engine.hpp"
#include "tests/benchmarks/step/austin.hpp"
#include "tests/benchmarks/step/measure.hpp"
#include "tests/benchmarks/step/moves.hpp"
#include "tests/property/step/skip_engine.hpp"

namespace lockstep::bench {
namespace {

constexpr auto kTickByTick = [](const Segment& segment, auto&& on_step) { tick_by_tick(segment, on_step); };
constexpr auto kSkipAhead = [](const Segment& segment, auto&& on_step) { skip_ahead(segment, on_step); };
constexpr auto kEngine = [](const Segment& segment, auto&& on_step) { for_each_step(segment, on_step); };

/// Executes the pieces from `segment`'s start and place, and leaves it at their end.
template <typename Form, typename OnStep>
void make_move(const std::vector<Piece>& pieces, Segment& segment, Form form, OnStep&& on_step) {
    for (const Piece& piece : pieces) {
        segment.piece = piece;
        form(segment, on_step);
        segment = {segment.end(), segment.to(), {}};
    }
}

/// off_plan_us and off_ideal_us: the largest distances of a step's time from the plan in whole ticks and from the
/// continuous trapezoid. A step made by tick n stands for the middle of that tick, and for a half-step crossing.
template <typename Form>
void report_accuracy(benchmark::State& state, const Limits& limits, Form form) {
    const Trapezoid plan = in_whole_ticks(limits);
    const Trapezoid ideal = continuous(limits);
    Segment segment{Tick{}, rest_position(0, false), {}};
    double off_plan = 0;
    double off_ideal = 0;
    double k = 0;
    make_move(pieces_of(limits), segment, form, [&](StepEdge edge) {
        const double time = static_cast<double>(edge.tick.value) - 0.5;
        off_plan = std::max(off_plan, std::abs(time - plan.time_of(k + 0.5)));
        off_ideal = std::max(off_ideal, std::abs(time - ideal.time_of(k + 0.5)));
        k += 1;
    });
    state.counters["off_plan_us"] = off_plan * 1e6 / kTicksPerSecond;
    state.counters["off_ideal_us"] = off_ideal * 1e6 / kTicksPerSecond;
    if (segment.from.count() != limits.steps || static_cast<std::int64_t>(k) != limits.steps) {
        state.SkipWithError("not the steps asked for");
    }
}

template <typename Form>
void step_one_axis(benchmark::State& state, const Limits& limits, std::int64_t moves, Form form) {
    const std::vector<Piece> pieces = pieces_of(limits);
    Times times;
    for (auto _ : state) {
        Segment segment{Tick{}, rest_position(0, false), {}};
        for (std::int64_t i = 0; i < moves; ++i) {
            make_move(pieces, segment, form, [&](StepEdge edge) { times(edge.tick.value); });
        }
        benchmark::DoNotOptimize(times);
    }
    const auto n = static_cast<double>(moves);
    report_cost(state, n * static_cast<double>(limits.steps), n * in_whole_ticks(limits).duration());
    report_accuracy(state, limits, form);
}

void step_naive(benchmark::State& state, const Limits& limits, std::int64_t moves) {
    Times times;
    for (auto _ : state) {
        for (std::int64_t i = 0; i < moves; ++i) {
            austin(limits, [&](std::int64_t time) { times(time); });
        }
        benchmark::DoNotOptimize(times);
    }
    report_cost(state, static_cast<double>(moves * limits.steps),
                static_cast<double>(moves) * in_whole_ticks(limits).duration());
}

#define LOCKSTEP_BENCH_MOVE(move, limits, moves)                                                                      \
    BENCHMARK_CAPTURE(step_one_axis, move##_tick_by_tick, limits, moves, kTickByTick)->Unit(benchmark::kMillisecond); \
    BENCHMARK_CAPTURE(step_one_axis, move##_skip_ahead, limits, moves, kSkipAhead)->Unit(benchmark::kMillisecond);    \
    BENCHMARK_CAPTURE(step_one_axis, move##_engine, limits, moves, kEngine)->Unit(benchmark::kMillisecond);           \
    BENCHMARK_CAPTURE(step_naive, move##_austin, limits, moves)->Unit(benchmark::kMillisecond)

LOCKSTEP_BENCH_MOVE(M1, kM1, 1);
LOCKSTEP_BENCH_MOVE(M2, kM2, 1);
LOCKSTEP_BENCH_MOVE(M3, kM3, kM3Moves);

}  // namespace
}  // namespace lockstep::bench
