// The counters of the step benchmarks.
#pragma once

#include <benchmark/benchmark.h>

#include <array>
#include <cstdint>

namespace lockstep::bench {

/// The destination of step times: a step is computed when its time is in memory.
class Times {
public:
    void operator()(std::int64_t time) {
        *next_++ = time;
        if (next_ == ring_.end()) { next_ = ring_.begin(); }
    }

private:
    std::array<std::int64_t, 4096> ring_{};
    std::array<std::int64_t, 4096>::iterator next_ = ring_.begin();
};

/// Counters ns_per_step and ns_per_tick; `steps` and `ticks` are the sums over all axes in one iteration.
inline void report_cost(benchmark::State& state, double steps, double ticks) {
    const auto nanoseconds_per = [](double total) {
        return benchmark::Counter(total * 1e-9,
                                  benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    };
    state.counters["ns_per_step"] = nanoseconds_per(steps);
    state.counters["ns_per_tick"] = nanoseconds_per(ticks);
}

}  // namespace lockstep::bench
