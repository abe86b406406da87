#include "tests/benchmarks/planners/table.hpp"

#include <algorithm>
#include <chrono>
#include <cstdarg>
#include <cstdio>

#include "clients/planning/plan_summary.hpp"
#include "tests/benchmarks/planners/grbl_planner.hpp"
#include "tests/benchmarks/planners/klipper_planner.hpp"
#include "tests/benchmarks/planners/lockstep_motion.hpp"

namespace lockstep::planners {
namespace {

constexpr double kGrblChordError_mm = 0.002;  // grbl's default

__attribute__((format(printf, 1, 2))) std::string text(const char* format, ...) {
    char buffer[512];
    va_list values;
    va_start(values, format);
    std::vsnprintf(buffer, sizeof buffer, format, values);
    va_end(values);
    return buffer;
}

std::vector<StraightMove> moves_for(Other other, const NamedProgram& named) {
    const bool is_klipper = other == Other::Klipper || other == Other::KlipperWithoutCruise;
    return straight_moves(named.program,
                          is_klipper ? chords_of_length(named.klipper_chord_mm) : chords_of_error(kGrblChordError_mm));
}

Speeds plan_by(Other other, const std::vector<StraightMove>& moves, const Limits& limits) {
    KlipperSetup klipper = klipper_setup(limits);
    if (other == Other::KlipperWithoutCruise) { klipper.minimum_cruise_ratio = 0; }
    if (other == Other::Klipper || other == Other::KlipperWithoutCruise) { return plan_by_klipper(moves, klipper); }
    return plan_by_grbl(moves, limits, junction_deviation_mm(limits), other == Other::Grbl ? kGrblBlocks : kAllBlocks);
}

std::size_t count_moves(const Program& program) {
    return static_cast<std::size_t>(std::ranges::count_if(
        program.blocks, [](const Block& block) { return std::holds_alternative<ProgramMove>(block.action); }));
}

std::string refused(const NamedProgram& named, const PlanError& error) {
    return named.name + ": " + line_label(error.line) + error.text;
}

std::string time_row(const Row& row) {
    std::string line = text("| %s | %zu | %.3f |", row.name.c_str(), row.moves, row.lockstep.seconds);
    for (const Result& other : row.others) { line += text(" %.3f |", other.seconds / row.lockstep.seconds); }
    return line + "\n";
}

std::string shares_text(const ChangeShares& shares) {
    return text(" %.2f / %.2f / %.2f |", shares[0], shares[1], shares[2]);
}

std::string change_row(const Row& row) {
    return "| " + row.name + " |" + shares_text(row.lockstep.changes) +
           shares_text(row.others[static_cast<std::size_t>(Other::Klipper)].changes) +
           shares_text(row.others[static_cast<std::size_t>(Other::Grbl)].changes) +
           shares_text(row.others[static_cast<std::size_t>(Other::GrblAllKnown)].changes) + "\n";
}

/// The least of three runs.
template <typename Work>
double ns_of(const Work& work) {
    using Clock = std::chrono::steady_clock;
    double least = std::numeric_limits<double>::infinity();
    for (int n = 0; n < 3; ++n) {
        const auto begin = Clock::now();
        work();
        least = std::min(least, std::chrono::duration<double, std::nano>(Clock::now() - begin).count());
    }
    return least;
}

}  // namespace

std::expected<Row, std::string> compare(const MachineConfig& machine, const NamedProgram& named) {
    const auto lockstep = lockstep_motion(machine, named.program);
    if (!lockstep) { return std::unexpected(refused(named, lockstep.error())); }
    Row row{.name = named.name,
            .moves = count_moves(named.program),
            .lockstep = {lockstep->seconds, lockstep->changes},
            .others = {}};
    const Limits limits = limits_of(machine);
    for (std::size_t k = 0; k < kOthers; ++k) {
        const auto other = static_cast<Other>(k);
        const std::vector<StraightMove> moves = moves_for(other, named);
        const Speeds speeds = plan_by(other, moves, limits);
        row.others[k] = {seconds_of(moves, speeds), changes_of(moves, speeds, limits)};
    }
    return row;
}

std::string tables_text(const std::vector<Row>& rows, const Limits& limits) {
    const KlipperSetup klipper = klipper_setup(limits);
    std::string all = text(
        "Klipper: max_velocity %g, max_accel %g, max_z_velocity %g, max_z_accel %g, square_corner_velocity %g. "
        "grbl: junction deviation %.4f mm.\n\n",
        klipper.max_velocity, klipper.max_acceleration, klipper.max_z_velocity, klipper.max_z_acceleration,
        klipper.square_corner_velocity, junction_deviation_mm(limits));
    all +=
        "| job | moves | Lockstep, s | Klipper | Klipper, minimum_cruise_ratio 0 | grbl, 16 blocks | grbl, all known "
        "|\n";
    all += "|---|---|---|---|---|---|---|\n";
    for (const Row& row : rows) { all += time_row(row); }
    all +=
        "\n| greatest change of speed in 0.2 / 5 / 20 ms | Lockstep | Klipper | grbl, 16 blocks | grbl, all known |\n";
    all += "|---|---|---|---|---|\n";
    for (const Row& row : rows) { all += change_row(row); }
    return all;
}

std::expected<std::string, std::string> costs_text(const MachineConfig& machine,
                                                   const std::vector<NamedProgram>& programs) {
    const Limits limits = limits_of(machine);
    std::string all =
        "| ns per move | Lockstep, with frames | Klipper | grbl, 16 blocks | grbl, all known "
        "|\n|---|---|---|---|---|\n";
    for (const NamedProgram& named : programs) {
        const auto count = static_cast<double>(count_moves(named.program));
        if (const auto plan = plan_program(machine, named.program); !plan) {
            return std::unexpected(refused(named, plan.error()));
        }
        all += text("| %s | %.0f |", named.name.c_str(),
                    ns_of([&] { (void)plan_program(machine, named.program); }) / count);
        for (const Other other : {Other::Klipper, Other::Grbl, Other::GrblAllKnown}) {
            const std::vector<StraightMove> moves = moves_for(other, named);
            all += text(" %.0f |", ns_of([&] { (void)plan_by(other, moves, limits); }) / count);
        }
        all += "\n";
    }
    return all;
}

}  // namespace lockstep::planners
