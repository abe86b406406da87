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

/// Parses "X=-3.5". The error says what is wrong, and gives an example.
std::expected<AxisTarget, std::string> parse_target(std::string_view word);

struct MoveOptions {
    std::vector<std::string> targets;   // "X=10"; absolute machine mm
    std::optional<double> feed_mm_min;  // along the path; nullopt means rapid
    bool relative = false;              // targets are relative to the axes' positions
    bool own = false;                   // each axis by itself, not in a line
    std::optional<double> in_s;         // with `own`: how long each axis's move lasts
};

/// Starts at the axes' positions; axes that are not named stay. Fails if the machine lacks a named axis, an axis is
/// named twice, a place is outside the travel, or a feed or time is out of range or belongs to the other kind of move.
std::expected<Program, std::string> move_program(const MachineConfig& machine, const std::vector<double>& start_mm,
                                                 const MoveOptions& options);

struct ProbeOptions {
    MoveOptions move;          // with a feed
    std::optional<int> probe;  // its number; nullopt: the machine's only one
    bool away = false;         // it touches when it opens
    bool may_miss = false;
};

/// The number of a probe of the machine. `number`: nullopt for its only one. The error lists the machine's probes.
std::expected<int, std::string> chosen_probe(const MachineConfig& machine, std::optional<int> number);

/// Like move_program(), for a move that ends where a probe touches. Also fails without a feed, if the machine lacks the
/// probe, or if no axis moves.
std::expected<Program, std::string> probe_program(const MachineConfig& machine, const std::vector<double>& start_mm,
                                                  const ProbeOptions& options);

/// The requested duration of own moves in whole ticks; nullopt if none was requested.
std::optional<Ticks> ticks_of(const MachineConfig& machine, const MoveOptions& options);

/// Returns the axis's index in the configuration, ignoring case. The error lists the existing names.
std::expected<AxisIndex, std::string> find_axis(const MachineConfig& machine, std::string_view name);

}  // namespace lockstep
