// The approach to the place where a program continues: lift, cross, and only then go down to the work.
#pragma once

#include <expected>
#include <string>
#include <vector>

#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep {

/// An axis that leaves the work first, and where it is clear of it.
struct Lift {
    std::size_t axis = 0;
    double mm = 0;
    bool is_asked = false;  // it goes exactly there; else it stays where it is farther from the work
};

/// "Z=40,W=0"; empty: the axes with a safe height, to it; without any, the axes that home first, to where they are
/// parked, since there they wait while the others search for their switches. Error: it names no place of this machine,
/// or nothing tells which axis lifts.
std::expected<std::vector<Lift>, std::string> lifts_of(const MachineConfig& machine, const std::string& option);

/// Where the program is before its first block of `line` or behind it.
std::vector<double> place_before(const Program& program, std::int32_t line);

/// The feed of the last move before that block, or else of the first one behind it; 0: all are rapid.
double feed_before(const Program& program, std::int32_t line);

struct ApproachMove {
    std::string what;  // "lifts", "crosses", "goes down", "goes straight"
    LinearMove move;
    double length_mm = 0;
};

/// In one line, as fast as the axes can.
std::vector<ApproachMove> straight_approach(const std::vector<double>& at_mm, const std::vector<double>& to_mm);

/// From `at_mm` to `to_mm`, a place for each axis: the lifting axes go clear; the others cross as fast as they can;
/// then the lifting ones go down with `feed_mm_s`, or where that is 0 as slowly as they start. What does not move is
/// left out.
std::vector<ApproachMove> approach(const MachineConfig& machine, const std::vector<Lift>& lifts,
                                   const std::vector<double>& at_mm, const std::vector<double>& to_mm,
                                   double feed_mm_s);

}  // namespace lockstep
