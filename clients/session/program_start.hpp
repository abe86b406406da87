// The start position of a program, from a command line.
#pragma once

#include <expected>
#include <string>
#include <vector>

#include "core/machine.hpp"

namespace lockstep {

struct NamedPlace {
    AxisIndex axis;
    double mm = 0;
};
/// Parses "X=10,Y=5", places within the axes' travel. The error says what is wrong, with an example.
std::expected<std::vector<NamedPlace>, std::string> places_named(const MachineConfig& machine, const std::string& list);

/// Parses "X=10,Y=5". Axes that are not named are at their park position. Fails like
/// places_named().
std::expected<std::vector<double>, std::string> places_at_start(const MachineConfig& machine, const std::string& start);

}  // namespace lockstep
