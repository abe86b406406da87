// Maps a piece of geometry from the axes to the rows of a PathSetup: the motors, then the axes.
//
// A map that is not linear makes other curves of quadratics. So the piece is cut into equal parts, as many as are
// needed to keep each motor within kMapShare of a step. In a part each motor has two quadratics of the same length. At
// both ends they have the place and the slope of the curve, and they meet with the same slope: no speed jumps at a cut.
#pragma once

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
    bool is_close() const;
    double cut_at(std::size_t part) const;
    Quadratic half(std::size_t number) const;

    const PathSetup& setup_;
    const Quadratic& axes_;
    std::size_t parts_ = 0;  // 0: all motors are quadratics along the piece
    std::size_t next_ = 0;
    std::size_t end_ = 1;
};

/// Where the motors rest if the axes rest at `at`.
MotorPositions motors_at_rest(const PathSetup& setup, std::span<const Position> at);
/// Each motor is on a whole step while the axes are at `at`, which is on whole steps of theirs.
bool are_motors_on_steps(const PathSetup& setup, const AxisVector& at);

}  // namespace lockstep
