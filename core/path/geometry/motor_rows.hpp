// Maps a piece of geometry from the axes to the rows of a PathSetup: the motors, then the axes.
//
// A map that is not linear makes other curves of quadratics. So the piece is cut where a motor passes a knot of its
// screw, and between these cuts into equal parts, as many as are needed to keep each motor within kMapShare of a step.
// In a part each motor has two quadratics of the same length. At both ends they have the place and the slope of the
// curve, and they meet with the same slope: no speed jumps at a cut. Of a straight piece that passes knots they are
// exactly the curve.
#pragma once

#include <vector>

#include "core/motion/path.hpp"
#include "core/path/geometry/quadratic.hpp"
#include "core/path/path_setup.hpp"

namespace lockstep {

/// The rows of one piece of the axes, in order. Where the machine rests, the motors are on whole steps: each within
/// half a step of its place by the map.
class RowPieces {
public:
    RowPieces(const PathSetup& setup, const Quadratic& axes);

    bool is_done() const { return next_ == end_; }
    Quadratic next();

private:
    void add_knots(MotorIndex motor, std::vector<double>& at) const;
    std::vector<double> knots() const;
    void add_parts(double from, double to);
    bool is_close(double from, double to) const;
    Quadratic half(std::size_t number) const;

    const PathSetup& setup_;
    const Quadratic& axes_;
    std::vector<double> cuts_;  // the parts' ends, mm; empty: all motors are quadratics along the piece
    std::size_t next_ = 0;
    std::size_t end_ = 1;
};

/// A part of a piece of the axes.
Quadratic part_of(const Quadratic& axes, double from, double to);
/// Where the motors rest if the axes rest at `at`.
MotorPositions motors_at_rest(const PathSetup& setup, std::span<const Position> at);
/// Each motor is on a whole step while the axes are at `at`, which is on whole steps of theirs.
bool are_motors_on_steps(const PathSetup& setup, const PlaceVector& at);

}  // namespace lockstep
