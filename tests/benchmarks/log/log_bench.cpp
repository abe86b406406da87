// The cost of reading a log, per step and compared with reading its bytes alone: three axes on diagonals of a plate,
// recorded by the simulated machine.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "clients/analysis/analysis.hpp"
#include "clients/merge/log_merge.hpp"
#include "clients/simulation/simulate.hpp"
#include "clients/verification/verification.hpp"
#include "services/record/sinks.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

constexpr int kCrossings = 20;

MachineSetup machine() {
    AxisConfig axis{.steps_per_mm = 1000,
                    .start_velocity_mm_s = 10,
                    .max_velocity_mm_s = 100,
                    .max_accel_mm_s2 = 1500,
                    .max_decel_mm_s2 = 1500,
                    .position_min_mm = 0,
                    .position_max_mm = 200};
    axis.homing = {
        .search_velocity_mm_s = 10, .latch_velocity_mm_s = 2, .pulloff_mm = 1, .switch_position_mm = -1, .park_mm = 5};
    axis.plant = {.start_position_mm = 8, .travel_margin_mm = 2, .max_torque_accel_mm_s2 = 2250, .max_jump_mm_s = 15};
    MachineSetup machine{{.name = "bench", .axes = {axis, axis, axis}}};
    for (std::size_t i = 0; i < 3; ++i) { machine.axes[i].name = std::string(1, static_cast<char>('X' + i)); }
    return machine;
}

Program there_and_back() {
    Program program{.name = "bench", .axes = {"X", "Y", "Z"}, .start_mm = {5, 5, 5}};
    for (int i = 0; i < kCrossings; ++i) {
        const double to = i % 2 == 0 ? 105 : 5;
        program.blocks.push_back({i + 1, ProgramMove{{to, to * 0.9, to * 0.7}, 150, false}});
    }
    return program;
}

/// A log that is written once, and removed at the end.
struct BenchLog {
    fs::path path = fs::temp_directory_path() / "lockstep-bench.lcm";
    std::int64_t steps = 0;

    BenchLog() {
        LogSink sink(LogWriter::open(path).value());
        steps = simulate(machine(), there_and_back(), sink).value().steps;
        sink.flush();
    }
    BenchLog(const BenchLog&) = delete;
    BenchLog& operator=(const BenchLog&) = delete;
    ~BenchLog() { fs::remove(path); }
};

/// Items are steps. Compare with log_bytes of the same run.
void with_log(benchmark::State& state, const std::function<bool(const fs::path&)>& read) {
    static const BenchLog log;
    for (auto _ : state) {
        if (!read(log.path)) { state.SkipWithError("the log cannot be read"); }
    }
    const auto times = static_cast<std::int64_t>(state.iterations());
    state.SetItemsProcessed(times * log.steps);
    state.SetBytesProcessed(times * static_cast<std::int64_t>(fs::file_size(log.path)));
}

bool read_bytes(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::vector<char> window(1 << 20);
    while (file.read(window.data(), static_cast<std::streamsize>(window.size()))) {
        benchmark::DoNotOptimize(window.data());
    }
    return file.eof();
}

bool analyze(const fs::path& path) { return analysis::analyze_log(path).has_value(); }
bool analyze_without_page(const fs::path& path) { return analysis::analyze_log(path, {.curves = false}).has_value(); }
bool verify(const fs::path& path) { return verification::verify_log(path).has_value(); }
bool merge_two(const fs::path& path) {
    NoSink nowhere;
    return merge::merge_logs({.logs = {path, path}, .progress = {}}, nowhere).has_value();
}

BENCHMARK_CAPTURE(with_log, log_bytes, read_bytes)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(with_log, log_analyze, analyze)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(with_log, log_analyze_without_page, analyze_without_page)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(with_log, log_verify, verify)->UseRealTime()->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(with_log, log_merge_with_itself, merge_two)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lockstep
