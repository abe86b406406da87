// Turns the ticks of steps into add-only pieces that make each step at exactly that tick.
//
// A piece has one speed, as many steps as that speed can make at the ticks asked: step j of it falls in tick T of it if
//   e + v T >= j  and  e + v (T - 1) < j,   so  (j - e)/T <= v < (j - e)/(T - 1),
// e being how far beyond the last half-step place the piece begins. Of that range the speed is taken that is nearest to
// the one asked for, and what it goes beyond the last step is the next piece's e: an integer, so nothing is rounded
// away. Steps at equal intervals make one piece, and so do those of any speed that is only rounded to ticks.
#pragma once

#include <cstdint>
#include <optional>

#include "core/step/segment.hpp"

namespace lockstep {

class StepPieces {
public:
    /// One more step, at the tick nearest to so many ticks from the start of the move; at least three after the one
    /// before. Returns the piece before it, where this step does not fit into it.
    std::optional<Piece> add(double ticks);
    /// The piece in hand, up to the last step; none where there is none.
    std::optional<Piece> cut();
    /// From the last step to the whole step, half a step on, at the speed last made.
    Piece last_half() const;

    /// Of the piece in hand; the start of the move at first.
    Ticks begin() const { return begin_; }
    Ticks last_step() const { return last_; }

private:
    bool take(Ticks at);
    Piece cut(double next_speed);

    static constexpr Int128 kFastest = (Int128{1} << 63) - 1;
    static constexpr Ticks kLeastTicks{3};  // the engine makes at most one step in two

    Ticks begin_;                // of the piece in hand, at a step
    Ticks last_;                 // step, of all
    std::int64_t steps_ = 0;     // of the piece in hand
    Int128 beyond_ = kHalfStep;  // e: a move begins on a whole step, half a step before its first
    Int128 slowest_ = 0;         // v: its range so far
    Int128 fastest_ = kFastest;
    double asked_ = 0;       // when the last step was asked for, in ticks
    std::int64_t made_ = 0;  // the speed of the piece made last
};

}  // namespace lockstep
