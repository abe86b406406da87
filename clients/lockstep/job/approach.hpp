// The approach to the place where a program continues: lift, cross, and only then go down to the work.
#pragma once

#include <expected>
#include <string>
#include <vector>

#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep {

/// An axis that leaves the work first, and its position clear of the work.
struct Lift {
    std::size_t axis = 0;
    double mm = 0;
    bool is_asked = false;  // it goes exactly there; else it stays if it is farther from the work
};

/// "Z=40,W=0"; empty: the axes with a safe height, to it; if there are none, the axes that home first, to their park
/// positions, since they wait there while the others search for their switches. Error: it names no place of this
/// machine, or the lifting axis is unknown.
std::expected<std::vector<Lift>, std::string> lifts_of(const MachineConfig& machine, const std::string& option);

/// The program's position before its first block of `line` or after it.
std::vector<double> place_before(const Program& program, std::int32_t line);

/// The feed of the last move before that block, or else of the first one after it; 0: all are rapid.
double feed_before(const Program& program, std::int32_t line);

struct ApproachMove {
    std::string what;  // "lifts", "crosses", "goes down", "goes straight"
    ProgramMove move;
    double length_mm = 0;
};

/// In one line, as fast as the axes can.
std::vector<ApproachMove> straight_approach(const std::vector<double>& at_mm, const std::vector<double>& to_mm);

/// From `at_mm` to `to_mm`, a place for each axis: the lifting axes go clear; the others cross as fast as they can;
/// then the lifting ones go down with `feed_mm_s`, or if that is 0 at their start velocity. Axes that do not move are
/// left out.
std::vector<ApproachMove> approach(const MachineConfig& machine, const std::vector<Lift>& lifts,
                                   const std::vector<double>& at_mm, const std::vector<double>& to_mm,
                                   double feed_mm_s);

}  // namespace lockstep
