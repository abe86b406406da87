// The approach to the place where a program continues: lift, cross, then go down to the work.
#pragma once

#include <expected>
#include <string>
#include <vector>

#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep {

/// An axis that leaves the work first, and a position clear of the work.
struct Lift {
    AxisIndex axis;
    double mm = 0;
    bool is_asked = false;  // the user named it: it goes exactly there; else it stays if it is farther from the work
};

/// Parses "Z=40,W=0". If `option` is empty, returns the axes with a safe height. If there are none, returns the axes
/// that home first, with their park positions, where they wait while the others search for their switches. Fails if
/// `option` names no place of this machine, or if the lifting axis is unknown.
std::expected<std::vector<Lift>, std::string> lifts_of(const MachineConfig& machine, const std::string& option);

/// The program's position before its first block of `line` or of a later line.
std::vector<double> place_before(const Program& program, std::int32_t line);

/// The feed of the last feed move before that block, else of the first one after it; 0 if all moves are rapid.
double feed_before(const Program& program, std::int32_t line);

struct ApproachMove {
    std::string what;  // "lifts", "crosses", "goes down", "goes straight"
    ProgramMove move;
    double length_mm = 0;
};

/// One straight move, as fast as the axes can.
std::vector<ApproachMove> straight_approach(const std::vector<double>& at_mm, const std::vector<double>& to_mm);

/// The moves from `at_mm` to `to_mm`, positions of each axis. The lifting axes go clear, the others cross as fast as
/// they can, and then the lifting axes go down with `feed_mm_s`, or with their start velocity if that is 0. Moves
/// without motion are left out.
std::vector<ApproachMove> approach(const MachineConfig& machine, const std::vector<Lift>& lifts,
                                   const std::vector<double>& at_mm, const std::vector<double>& to_mm,
                                   double feed_mm_s);

}  // namespace lockstep
