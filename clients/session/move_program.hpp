// Makes a program of one move from "X=10 Y=-3.5". Pure.
#pragma once

#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep {

struct AxisTarget {
    std::string axis;
    double mm = 0;
};

/// "X=-3.5". Error: what is wrong with it, and an example.
std::expected<AxisTarget, std::string> parse_target(std::string_view word);

struct MoveOptions {
    std::vector<std::string> targets;        // "X=10"; absolute machine mm
    std::optional<double> feed_mm_min = {};  // along the path; none: rapid
    bool relative = false;                   // targets are relative to the axes' positions
    bool own = false;                        // each axis by itself, not in a line
    std::optional<double> in_s = {};         // own: how long each axis's move lasts
};

/// From the axes' positions; axes not named stay. Errors: an axis that the machine lacks or that is named twice, a
/// place outside the travel, a feed or a time out of range, or of another kind of move.
std::expected<Program, std::string> move_program(const MachineConfig& machine, const std::vector<double>& start_mm,
                                                 const MoveOptions& options);

/// The requested duration of own moves, to the tick; 0: none.
Ticks ticks_of(const MachineConfig& machine, const MoveOptions& options);

/// The axis's index in the configuration; capitals do not matter. Error: the names there are.
std::expected<std::size_t, std::string> find_axis(const MachineConfig& machine, std::string_view name);

}  // namespace lockstep
