#include "core/path/geometry/motor_rows.hpp"

#include <cmath>

namespace lockstep {
namespace {

/// The rows of the axes are behind the motors'.
void append_axes(AxisVector& rows, const AxisVector& axes) {
    for (const double value : axes) { rows.append(value); }
}

}  // namespace

Quadratic rows_of(const PathSetup& setup, const Quadratic& axes) {
    Quadratic rows = axes;
    rows.from.clear();
    rows.slope.clear();
    rows.bend.clear();
    AxisVector end;
    for (std::size_t i = 0; i < setup.axes(); ++i) { end.append(axes.place(i, axes.length)); }
    const bool is_rest = axes.length == 0;
    const LinearMap& map = setup.motor_map;
    for (std::size_t m = 0; m < setup.motors(); ++m) {
        rows.from.append(map.place(m, axes.from));
        rows.slope.append(map.place(m, axes.slope));
        rows.bend.append(map.place(m, axes.bend));
        if (axes.begins_at_rest || is_rest) { rows.from[m] = std::round(rows.from[m]); }
        if (is_rest || !(axes.begins_at_rest || axes.ends_at_rest)) { continue; }
        const double to = map.place(m, end);
        rows.slope[m] = ((axes.ends_at_rest ? std::round(to) : to) - rows.from[m]) / axes.length;
    }
    append_axes(rows.from, axes.from);
    append_axes(rows.slope, axes.slope);
    append_axes(rows.bend, axes.bend);
    return rows;
}

MotorPositions motors_at_rest(const PathSetup& setup, std::span<const Position> at) {
    MotorPositions motors;
    if (!setup.has_map()) {
        for (const Position& position : at) { motors.append(position); }
        return motors;
    }
    AxisVector axes;
    for (const Position& position : at) { axes.append(position.as_steps()); }
    for (std::size_t m = 0; m < setup.motors(); ++m) {
        motors.append(Position::steps(std::llround(setup.motor_map.place(m, axes))));
    }
    return motors;
}

}  // namespace lockstep
