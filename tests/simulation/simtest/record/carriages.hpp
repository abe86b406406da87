// The carriages of a delta, by the machine's configuration. It shares no code with core/kinematics.
//
// A tower stands at (x, y). A rod leads from its carriage to the tool: with p and q the tool's x and y minus the
// tower's, the carriage is at z + sqrt(rod^2 - p^2 - q^2). All in mm, in long double.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/machine.hpp"

namespace lockstep::simtest {

class Carriages {
public:
    using Tool = std::array<long double, 3>;  // x, y, z: a place of the tool, or a change of it

    explicit Carriages(const MachineConfig& machine);

    bool none() const { return towers_.empty(); }
    std::optional<std::size_t> tower_of(const std::string& motor) const;
    /// 0 for X, 1 for Y, 2 for Z; nullopt for other axes.
    std::optional<std::size_t> coordinate_of(std::size_t axis) const;
    /// `axes`: the places of all axes of the machine.
    Tool tool(const std::vector<double>& axes_mm) const;

    long double height(std::size_t tower, const Tool& at) const { return at[2] + rise(tower, at); }
    /// By how much the carriage goes for a small change of the tool's place.
    long double change(std::size_t tower, const Tool& at, const Tool& by) const;
    /// The second derivative of the height, for a constant change of the tool's place.
    long double bend(std::size_t tower, const Tool& at, const Tool& by) const;
    /// The corner of the travel of X and Y that is furthest from the tower, at Z's lower end.
    Tool furthest_corner(std::size_t tower) const;
    /// The four corners of the travel of X and Y, and its middle.
    std::vector<Tool> samples() const;

private:
    long double rise(std::size_t tower, const Tool& at) const;

    std::vector<DeltaTower> towers_;
    std::array<std::size_t, 3> axes_{};
    Tool low_{};  // the travel
    Tool high_{};
};

}  // namespace lockstep::simtest
