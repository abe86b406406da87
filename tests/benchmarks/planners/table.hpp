// The comparison as the tables of a document.
#pragma once

#include <array>
#include <expected>
#include <string>
#include <vector>

#include "tests/benchmarks/planners/programs.hpp"
#include "tests/benchmarks/planners/speed_changes.hpp"

namespace lockstep::planners {

/// Klipper with and without its minimum_cruise_ratio, grbl with its buffer and with all blocks known.
enum class Other : std::size_t { Klipper, KlipperWithoutCruise, Grbl, GrblAllKnown };
inline constexpr std::size_t kOthers = 4;

/// The time of a job in seconds, and its changes of speed.
struct Result {
    double seconds = 0;
    ChangeShares changes{};
};

struct Row {
    std::string name;
    std::size_t moves = 0;
    Result lockstep;
    std::array<Result, kOthers> others;
};

/// Error: Lockstep's planner refuses the program.
std::expected<Row, std::string> compare(const MachineConfig& machine, const NamedProgram& named);

/// Both tables, with the limits that the other planners were given.
std::string tables_text(const std::vector<Row>& rows, const Limits& limits);

/// How long planning takes on this host: a table of nanoseconds per move of the G-code.
std::expected<std::string, std::string> costs_text(const MachineConfig& machine,
                                                   const std::vector<NamedProgram>& programs);

}  // namespace lockstep::planners
