// Prints what a change of an output costs: bytes on DDS and in the record, CPU time of the coordinator and of the
// motors, beside the same program on the same machine without outputs.
//
// usage: lockstep-output-cost MACHINE.textproto [MOVES]
//   MACHINE has axes X and Y, a spindle with pulses that follow the speed, and a digital output 0, as
//   deploy/examples/laser.textproto. MOVES: how many moves of 1 mm; each begins with a change. Default 2000.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "clients/planning/plan_summary.hpp"
#include "services/documents/machine_file.hpp"
#include "services/wire/dds/dds_log.hpp"
#include "tests/benchmarks/outputs/frame_sizer.hpp"
#include "tests/benchmarks/outputs/measured_run.hpp"

namespace lockstep {
namespace {

constexpr int kTimes = 15;  // each loop counts with its shortest time
constexpr int kMovesInLine = 150;
constexpr double kFeed_mm_s = 100;

using EventKind = ProgramEvent::Kind;

/// The words before each move, and before the first.
struct Words {
    const char* name;
    std::optional<ProgramEvent> begin;
    std::optional<ProgramEvent> odd;
    std::optional<ProgramEvent> even;
};

const Words kAllWords[]{
    {"digital, M62 and M63", {}, ProgramEvent{EventKind::OutputOn}, ProgramEvent{EventKind::OutputOff}},
    {"analog, S after M3", ProgramEvent{EventKind::SpindleForward, 0, 500},
     ProgramEvent{EventKind::SpindleSpeed, 0, 300}, ProgramEvent{EventKind::SpindleSpeed, 0, 600}},
    {"analog ramp, S after M4", ProgramEvent{EventKind::SpindleReverse, 0, 500},
     ProgramEvent{EventKind::SpindleSpeed, 0, 300}, ProgramEvent{EventKind::SpindleSpeed, 0, 600}},
};

/// Lines to and fro along X, of many moves each.
Program raster(const MachineConfig& machine, const Words& words, int moves) {
    Program program{.name = "raster", .axes = {"X", "Y"}, .start_mm = parked_mm(machine)};
    const auto add = [&](const std::optional<ProgramEvent>& event) {
        if (event) { program.blocks.emplace_back().action = *event; }
    };
    add(words.begin);
    for (int i = 0; i < moves; ++i) {
        add(i % 2 == 0 ? words.odd : words.even);
        const int line = i / kMovesInLine;
        const int along = i % kMovesInLine + 1;
        const double x = line % 2 == 0 ? along : kMovesInLine - along;
        ProgramMove move{{program.start_mm[0] + x, program.start_mm[1] + 0.1 * line}, kFeed_mm_s};
        move.mode = PathMode::ExactPath;  // no moves are joined, with or without words between them
        program.blocks.emplace_back().action = std::move(move);
    }
    return program;
}

void take_least(std::vector<std::chrono::nanoseconds>& least, const std::vector<std::chrono::nanoseconds>& other) {
    if (least.size() != other.size()) { throw std::runtime_error("the same run has another number of loops"); }
    for (std::size_t i = 0; i < least.size(); ++i) { least[i] = std::min(least[i], other[i]); }
}

double microseconds(const std::vector<std::chrono::nanoseconds>& times) {
    std::chrono::nanoseconds sum{};
    for (const auto time : times) { sum += time; }
    return std::chrono::duration<double, std::micro>(sum).count();
}

/// A program on the machine with its outputs, and without any.
struct Comparison {
    const Words& words;
    Program program;
    RunFigures with;
    RunFigures without;
};

MachineConfig without_outputs(MachineConfig machine) {
    machine.outputs.clear();
    return machine;
}

/// Keeps the shortest time of each loop.
void measure_again(const MachineConfig& machine, const Program& program, bool is_first, RunFigures& figures) {
    RunFigures again = measured_run(machine, program, [](const Frame&) { return std::size_t{0}; });
    if (!is_first) {
        take_least(again.coordinator, figures.coordinator);
        take_least(again.motors, figures.motors);
    }
    figures.coordinator = std::move(again.coordinator);
    figures.motors = std::move(again.motors);
}

/// Runs all programs in turn, so that other work of the host slows down all of them.
void measure_times(const MachineConfig& machine, std::vector<Comparison>& comparisons) {
    for (int i = 0; i < kTimes; ++i) {
        for (Comparison& one : comparisons) {
            measure_again(without_outputs(machine), one.program, i == 0, one.without);
            measure_again(machine, one.program, i == 0, one.with);
        }
    }
}

std::vector<Comparison> measured(const MachineConfig& machine, int moves) {
    auto sizer = FrameSizer::open();
    if (!sizer) { throw std::runtime_error(sizer.error()); }
    const FrameBytes bytes = [&](const Frame& frame) { return sizer->bytes(frame); };
    std::vector<Comparison> comparisons;
    for (const Words& words : kAllWords) {
        Program program = raster(machine, words, moves);
        RunFigures with = measured_run(machine, program, bytes);
        RunFigures without = measured_run(without_outputs(machine), program, bytes);
        if (with.steps != without.steps) { throw std::runtime_error("outputs change the motion"); }
        if (with.changes < moves) { throw std::runtime_error("the machine has no such output"); }
        comparisons.push_back({words, std::move(program), std::move(with), std::move(without)});
    }
    measure_times(machine, comparisons);
    return comparisons;
}

void print_rows(const Comparison& of) {
    const auto changes = static_cast<double>(of.with.changes);
    const auto row = [&](const char* what, double without, double with) {
        std::printf("| %s | %s | %.0f | %.0f | %.0f | %.2f | %.2f |\n", what, of.words.name, changes, without, with,
                    with / without, (with - without) / changes);
    };
    row("frames on DDS, bytes", static_cast<double>(of.without.frame_bytes), static_cast<double>(of.with.frame_bytes));
    row("record, bytes", static_cast<double>(of.without.record_bytes), static_cast<double>(of.with.record_bytes));
    row("coordinator, CPU, us", microseconds(of.without.coordinator), microseconds(of.with.coordinator));
    row("motors with simulated devices, CPU, us", microseconds(of.without.motors), microseconds(of.with.motors));
}

int run(const MachineConfig& machine, int moves) {
    const std::vector<Comparison> comparisons = measured(machine, moves);
    std::printf("%d moves of 1 mm at %.0f mm/s, %lld steps\n\n", moves, kFeed_mm_s,
                static_cast<long long>(comparisons.front().with.steps));
    std::printf(
        "| | changes | number | without outputs | with | ratio | for each change |\n|---|---|---|---|---|---|---|\n");
    for (const Comparison& comparison : comparisons) { print_rows(comparison); }
    return 0;
}

}  // namespace
}  // namespace lockstep

int main(int argc, char** argv) {
    const int moves = argc == 3 ? std::atoi(argv[2]) : 2000;
    if (argc < 2 || argc > 3 || moves < 1) {
        std::fprintf(stderr, "usage: lockstep-output-cost MACHINE.textproto [MOVES]\n");
        return 2;
    }
    const auto machine = lockstep::load_machine_file(argv[1]);
    if (!machine) {
        std::fprintf(stderr, "%s\n", to_text(argv[1], machine.error()).c_str());
        return 2;
    }
    lockstep::forward_dds_log([](const std::string&) {});  // it warns of its own end
    try {
        return lockstep::run(*machine, moves);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
