// The cost of a step if one process moves many axes, frame by frame: with each axis's engine in turn, and with all
// axes in vectors. ns_per_tick is for one axis.
#include <vector>

#include "core/step/engine.hpp"
#include "tests/benchmarks/step/many/run_many.hpp"
#include "tests/benchmarks/step/measure.hpp"
#include "tests/benchmarks/step/moves.hpp"

namespace lockstep::bench {
namespace {

/// Axes that each make `moves` moves of the same number of steps; each axis is slightly slower than the previous one.
struct Machine {
    std::vector<StepEngine> engines;
    std::vector<std::vector<Piece>> moves;
    std::vector<std::size_t> next;

    Machine(Limits limits, std::size_t axes, std::int64_t repeat) : engines(axes), moves(axes), next(axes) {
        for (std::vector<Piece>& pieces : moves) {
            const std::vector<Piece> move = pieces_of(limits);
            for (std::int64_t i = 0; i < repeat; ++i) { pieces.insert(pieces.end(), move.begin(), move.end()); }
            limits.max_velocity *= 0.99;
            limits.acceleration *= 0.995;
        }
    }

    void rewind() {
        for (StepEngine& engine : engines) { engine = StepEngine(Tick{}, rest_position(0, false)); }
        next.assign(engines.size(), 0);
    }
    /// Calls run(axis) for every piece in motion before `until`. False when every axis is done.
    template <typename Run>
    bool play(Tick until, Run&& run) {
        bool moving = false;
        for (std::size_t i = 0; i < engines.size(); ++i) {
            while (engines[i].now() < until && !(engines[i].idle() && next[i] == moves[i].size())) {
                if (engines[i].idle()) { engines[i].begin(moves[i][next[i]++]); }
                run(i);
                moving = true;
            }
        }
        return moving;
    }
    /// The ticks from first to last, summed over all axes.
    double ticks() const {
        double sum = 0;
        for (const StepEngine& engine : engines) { sum += static_cast<double>(engine.now().value); }
        return sum;
    }
};

struct Case {
    Limits limits;
    std::size_t axes;
    std::int64_t moves;
    Ticks frame;
};

void step_axes_in_turn(benchmark::State& state, const Case& what) {
    Machine machine(what.limits, what.axes, what.moves);
    Times times;
    for (auto _ : state) {
        machine.rewind();
        Tick until{what.frame.value};
        const auto run = [&](std::size_t i) {
            machine.engines[i].run(until, [&](StepEdge edge) { times(edge.tick.value); });
        };
        while (machine.play(until, run)) { until += what.frame; }
        benchmark::DoNotOptimize(times);
    }
    report_cost(state, static_cast<double>(what.limits.steps * what.moves) * static_cast<double>(what.axes),
                machine.ticks());
}

void step_axes_in_vectors(benchmark::State& state, const Case& what) {
    Machine machine(what.limits, what.axes, what.moves);
    std::vector<std::int64_t> room(EdgeBuffer::room_for(what.frame, 2));
    for (auto _ : state) {
        machine.rewind();
        Tick until{what.frame.value};
        const auto run = [&](std::size_t i) {
            EdgeBuffer edges(room);
            run_into(machine.engines[i], until, edges);
            benchmark::DoNotOptimize(room.data());
            benchmark::ClobberMemory();
        };
        while (machine.play(until, run)) { until += what.frame; }
    }
    report_cost(state, static_cast<double>(what.limits.steps * what.moves) * static_cast<double>(what.axes),
                machine.ticks());
}

constexpr Ticks kShort{5'000};   // a frame on a quiet network
constexpr Ticks kLong{230'000};  // a frame where hosts may stall for 100 ms

#define LOCKSTEP_BENCH_AXES(name, limits, axes, moves)                                        \
    BENCHMARK_CAPTURE(step_axes_in_turn, name##_5ms, (Case{limits, axes, moves, kShort}))     \
        ->Unit(benchmark::kMillisecond);                                                      \
    BENCHMARK_CAPTURE(step_axes_in_turn, name##_230ms, (Case{limits, axes, moves, kLong}))    \
        ->Unit(benchmark::kMillisecond);                                                      \
    BENCHMARK_CAPTURE(step_axes_in_vectors, name##_5ms, (Case{limits, axes, moves, kShort}))  \
        ->Unit(benchmark::kMillisecond);                                                      \
    BENCHMARK_CAPTURE(step_axes_in_vectors, name##_230ms, (Case{limits, axes, moves, kLong})) \
        ->Unit(benchmark::kMillisecond)

LOCKSTEP_BENCH_AXES(M1_8_axes, kM1, 8, 1);
LOCKSTEP_BENCH_AXES(M2_8_axes, kM2, 8, 1);
LOCKSTEP_BENCH_AXES(M3_8_axes, kM3, 8, 1000);
LOCKSTEP_BENCH_AXES(M1_32_axes, kM1, 32, 1);
LOCKSTEP_BENCH_AXES(M2_32_axes, kM2, 32, 1);
LOCKSTEP_BENCH_AXES(M3_32_axes, kM3, 32, 1000);

}  // namespace
}  // namespace lockstep::bench
