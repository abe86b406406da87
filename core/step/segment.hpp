// The unit of work of the add-only engine: constant acceleration for a whole number of ticks.
#pragma once

#include "core/units.hpp"

namespace lockstep {

/// The motion of a segment without its place in time and space. Frames and tails consist of pieces.
///
/// Each tick the engine does `velocity += acceleration; position += velocity`. `velocity` is the seed: the speed
/// half a tick before the piece, v0 - a/2, so that n ticks cover exactly v0*n + a*n^2/2 as the continuous motion does.
struct Piece {
    Ticks ticks;
    Velocity velocity;
    Acceleration acceleration;
    constexpr bool operator==(const Piece&) const = default;

    /// The distance that the piece covers in its first n ticks: n*v + a*n(n+1)/2.
    constexpr Displacement covered(Ticks n) const {
        const Int128 k = n.value;
        return {k * velocity.raw + k * (k + 1) / 2 * acceleration.raw};
    }
    constexpr Displacement covered() const { return covered(ticks); }
    /// The register's value after n ticks.
    constexpr Int128 velocity_after(Ticks n) const { return Int128{velocity.raw} + Int128{n.value} * acceleration.raw; }
};

/// The duration of pieces that follow each other.
template <typename Pieces>
constexpr Ticks total_ticks(const Pieces& pieces) {
    Ticks total;
    for (const Piece& piece : pieces) { total += piece.ticks; }
    return total;
}

/// A piece with its place in time and space.
struct Segment {
    Tick start;
    Position from;
    Piece piece;
    constexpr bool operator==(const Segment&) const = default;

    constexpr Tick end() const { return start + piece.ticks; }
    constexpr Position to() const { return from + piece.covered(); }
};

/// One step: the count becomes count + direction during this tick (ticks of a segment are start+1 ... start+ticks).
struct StepEdge {
    Tick tick;
    std::int8_t direction = 0;  // +1 or -1
    constexpr bool operator==(const StepEdge&) const = default;
};

}  // namespace lockstep
