// How long `lockstep check` and `lockstep plan` take for a file, and how much memory they use: a million short lines,
// and programs of few lines and much motion. For comparison, the same lines only read, and planned with all frames.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <string>

#include "clients/planning/plan_summary.hpp"
#include "clients/planning/program_text.hpp"
#include "clients/planning/read_ahead.hpp"
#include "services/documents/program_file.hpp"
#include "services/files/text_file.hpp"
#include "tests/temporary_directory.hpp"

namespace lockstep {
namespace {

MachineSetup mill() {
    MachineSetup machine{{.name = "mill"}};
    for (const char* name : {"X", "Y"}) {
        machine.axes.push_back({.name = name,
                                .steps_per_mm = 80,
                                .start_velocity_mm_s = 10,
                                .max_velocity_mm_s = 150,
                                .max_accel_mm_s2 = 1500,
                                .max_decel_mm_s2 = 1500,
                                .position_max_mm = 200});
    }
    machine.axes.push_back({.name = "Z",
                            .steps_per_mm = 400,
                            .start_velocity_mm_s = 4,
                            .max_velocity_mm_s = 25,
                            .max_accel_mm_s2 = 300,
                            .max_decel_mm_s2 = 300,
                            .position_max_mm = 60});
    return machine;
}

/// Lines of 0.05 to 1 mm, each turned by up to 0.4 rad, within a square of 80 mm.
std::string turns(int lines) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<> unit(0, 1);
    std::string text = "G21 G90 F3000\nG0 X50 Y50\n";
    double x = 50;
    double y = 50;
    double heading = 0;
    for (int k = 0; k < lines; ++k) {
        const double length = 0.05 + 0.95 * unit(random);
        heading += (2 * unit(random) - 1) * 0.4;
        const bool leaves =
            std::abs(x + length * std::cos(heading) - 50) > 40 || std::abs(y + length * std::sin(heading) - 50) > 40;
        if (leaves) { heading = std::atan2(50 - y, 50 - x); }
        x += length * std::cos(heading);
        y += length * std::sin(heading);
        char line[64];
        std::snprintf(line, sizeof line, "G1 X%.3f Y%.3f\n", x, y);
        text += line;
    }
    return text;
}

/// Arcs of 0.2 to 3.2 mm radius and 0.1 to 1.6 rad, each of which continues the direction of the one before.
std::string arcs(int lines) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<> unit(0, 1);
    std::string text = "G21 G90 F3000\nG0 X50 Y50\n";
    const auto rounded = [](double mm) { return std::round(mm * 1e4) / 1e4; };
    double x = 50;
    double y = 50;
    double heading = 0;
    for (int k = 0; k < lines; ++k) {
        const double radius = 0.2 + 3 * unit(random);
        const double sweep = 0.1 + 1.5 * unit(random);
        const bool leaves = std::abs(x - 50) > 40 || std::abs(y - 50) > 40;
        if (leaves) { heading = std::atan2(50 - y, 50 - x); }
        const double side = unit(random) < 0.5 ? 1 : -1;  // 1: counter-clockwise
        const double centre_x = -side * radius * std::sin(heading);
        const double centre_y = side * radius * std::cos(heading);
        heading += side * sweep;
        char line[96];
        std::snprintf(line, sizeof line, "G%d X%.4f Y%.4f I%.4f J%.4f\n", side > 0 ? 3 : 2,
                      x + centre_x + side * radius * std::sin(heading),
                      y + centre_y - side * radius * std::cos(heading), centre_x, centre_y);
        x = rounded(x + centre_x + side * radius * std::sin(heading));
        y = rounded(y + centre_y - side * radius * std::cos(heading));
        text += line;
    }
    return text;
}

const std::string kHelix = "G21 G90 F3000\nG0 X50 Y50 Z20\nG2 X50 Y50 Z10 I2 J0 P100000\n";
const std::string kSlowArc = "G21 G90 F3000\nG0 X90 Y50\nG1 X90.5 F100\nG2 X90.5 Y50 I-40 J0 P8 F1\nG0 X10\n";

class PlannedFile {
public:
    explicit PlannedFile(const std::string& text) {
        if (!write_text_file(file_, text)) { std::abort(); }
    }
    std::shared_ptr<ProgramText> open() const {
        return std::make_shared<ProgramText>(LineReader::open(file_.string()).value(),
                                             program_setup(file_, machine_, parked_mm(machine_)));
    }
    void plan(const OnPlannedFrame& each_frame) const {
        const auto text = open();
        const ProgramHead head = text->head();
        const auto blocks = std::make_shared<ReadAhead>(text);
        const auto plan = plan_blocks(
            machine_, head, blocks,
            {.start = start_counts(machine_, head), .overrides = {}, .each_frame = each_frame, .progress = {}});
        blocks->stop();
        if (!plan || !text->errors().empty()) { std::abort(); }
        benchmark::DoNotOptimize(plan->duration);
    }
    void read() const {
        const auto text = open();
        std::uint32_t block = 0;
        while (text->block(block) != nullptr) { ++block; }
        benchmark::DoNotOptimize(block);
    }

private:
    TemporaryDirectory directory_;
    std::filesystem::path file_ = directory_.path() / "program.gcode";
    MachineSetup machine_ = mill();
};

void forget_peak_of_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

double peak_of_memory_mb() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        double kb = 0;
        if (word == "VmHWM:" && status >> kb) { return kb / 1024; }
    }
    return 0;
}

template <typename Work>
void measure(benchmark::State& bench, const std::string& text, Work work) {
    const PlannedFile file(text);
    const auto lines = static_cast<double>(std::ranges::count(text, '\n'));
    forget_peak_of_memory();
    for (auto _ : bench) { work(file); }
    bench.counters["lines/s"] =
        benchmark::Counter(lines * static_cast<double>(bench.iterations()), benchmark::Counter::kIsRate);
    bench.counters["most_MB"] = peak_of_memory_mb();
}

constexpr int kLines = 1'000'000;
constexpr int kArcs = 200'000;
constexpr int kLinesWithFrames = 100'000;

void Read(benchmark::State& bench) {
    measure(bench, turns(kLines), [](const PlannedFile& file) { file.read(); });
}
BENCHMARK(Read)->Name("plan/turns/only_read")->UseRealTime()->Unit(benchmark::kMillisecond);

void Turns(benchmark::State& bench) {
    measure(bench, turns(kLines), [](const PlannedFile& file) { file.plan({}); });
}
BENCHMARK(Turns)->Name("plan/turns")->UseRealTime()->Unit(benchmark::kMillisecond);

void TurnsWithFrames(benchmark::State& bench) {
    measure(bench, turns(kLinesWithFrames), [](const PlannedFile& file) { file.plan([](const PlannedFrame&) {}); });
}
BENCHMARK(TurnsWithFrames)->Name("plan/turns/with_frames")->UseRealTime()->Unit(benchmark::kMillisecond);

void ReadArcs(benchmark::State& bench) {
    measure(bench, arcs(kArcs), [](const PlannedFile& file) { file.read(); });
}
BENCHMARK(ReadArcs)->Name("plan/arcs/only_read")->UseRealTime()->Unit(benchmark::kMillisecond);

void Arcs(benchmark::State& bench) {
    measure(bench, arcs(kArcs), [](const PlannedFile& file) { file.plan({}); });
}
BENCHMARK(Arcs)->Name("plan/arcs")->UseRealTime()->Unit(benchmark::kMillisecond);

void Helix(benchmark::State& bench) {
    measure(bench, kHelix, [](const PlannedFile& file) { file.plan({}); });
}
BENCHMARK(Helix)->Name("plan/helix")->UseRealTime()->Unit(benchmark::kMillisecond);

void SlowArc(benchmark::State& bench) {
    measure(bench, kSlowArc, [](const PlannedFile& file) { file.plan({}); });
}
BENCHMARK(SlowArc)->Name("plan/slow_arc")->UseRealTime()->Unit(benchmark::kMillisecond);

void SlowArcWithFrames(benchmark::State& bench) {
    measure(bench, kSlowArc, [](const PlannedFile& file) { file.plan([](const PlannedFrame&) {}); });
}
BENCHMARK(SlowArcWithFrames)
    ->Name("plan/slow_arc/with_frames")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
}  // namespace lockstep
