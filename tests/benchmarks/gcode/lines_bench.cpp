// Measures how many plain lines of G-code are read per second.
#include <benchmark/benchmark.h>

#include <string>

#include "core/gcode/interpreter.hpp"
#include "core/gcode/text_lines.hpp"

namespace lockstep::gcode {
namespace {

std::string plain_lines(int count) {
    std::string text = "G1 F600\n";
    for (int i = 0; i < count; ++i) {
        text += "G1 X" + std::to_string(i % 200) + "." + std::to_string(100 + i % 900) + " Y" +
                std::to_string(i % 177) + ".5\n";
    }
    return text;
}

void read_plain_lines(benchmark::State& bench) {
    constexpr int kLines = 100'000;
    const std::string text = plain_lines(kLines);
    double sum = 0;
    for (auto _ : bench) {
        Interpreter interpreter({}, State{},
                                [&](const Action& action, int) { sum += std::get<Straight>(action).target[0]; });
        for_each_line(text,
                      [&](std::string_view line, int number) { return interpreter.take(line, number).has_value(); });
    }
    benchmark::DoNotOptimize(sum);
    bench.counters["lines/s"] = benchmark::Counter(
        static_cast<double>(kLines) * static_cast<double>(bench.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(read_plain_lines)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lockstep::gcode
