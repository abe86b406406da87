// The cost of translating and checking a frame, without the network.
#include <benchmark/benchmark.h>

#include "services/wire/translate/translate.hpp"
#include "tests/benchmarks/wire/frame_sizes.hpp"

namespace lockstep {
namespace {

void to_wire_and_back(benchmark::State& state, const Frame& frame) {
    Frame received;
    for (auto _ : state) {
        const auto message = to_wire(frame);
        benchmark::DoNotOptimize(from_wire(message, received));
    }
}

BENCHMARK_CAPTURE(to_wire_and_back, wire_frame_of_3_axes, frame_of_3_axes());
BENCHMARK_CAPTURE(to_wire_and_back, wire_frame_of_32_axes, frame_of_32_axes());

}  // namespace
}  // namespace lockstep
