// Turns the ticks of steps into add-only pieces that make each step at exactly that tick.
//
// A piece has one speed and as many steps as that speed makes at the ticks asked for. Its step j falls in its tick T if
//   e + v T >= j  and  e + v (T - 1) < j,   so  (j - e)/T <= v < (j - e)/(T - 1),
// where e is how far beyond the last half-step place the piece begins. The piece gets the speed of that range that is
// nearest to the one asked for. Its distance beyond its last step is the next piece's e. e is an integer, so nothing is
// lost by rounding. Steps at equal intervals make one piece. So do the steps of a constant speed, rounded to ticks.
#pragma once

#include <cstdint>
#include <optional>

#include "core/step/segment.hpp"

namespace lockstep {

class StepPieces {
public:
    /// Adds a step at the tick nearest to `ticks` after the start of the move, at least three ticks after the step
    /// before. Returns the piece in hand if this step does not fit into it.
    std::optional<Piece> add(double ticks);
    /// Returns the piece in hand, up to the last step, or nullopt if it has no step.
    std::optional<Piece> cut();
    /// The piece from the last step to the whole step half a step ahead, at the speed of the last piece.
    Piece last_half() const;

    /// The start of the piece in hand; at first that of the move.
    Ticks begin() const { return begin_; }
    Ticks last_step() const { return last_; }

private:
    bool take(Ticks at);
    Piece cut(double next_speed);

    static constexpr Int128 kFastest = (Int128{1} << 63) - 1;
    static constexpr Ticks kLeastTicks{3};  // the engine makes at most one step in two ticks

    Ticks begin_;                // start of the piece in hand, at a step
    Ticks last_;                 // the last step of all
    std::int64_t steps_ = 0;     // of the piece in hand
    Int128 beyond_ = kHalfStep;  // e: a move begins on a whole step, half a step before its first
    Int128 slowest_ = 0;         // the range of v so far
    Int128 fastest_ = kFastest;
    double asked_ = 0;       // when the last step was asked for, in ticks
    std::int64_t made_ = 0;  // the speed of the piece made last
};

}  // namespace lockstep
