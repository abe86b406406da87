// The condition for the step engine to execute a piece exactly. Code that takes pieces from outside checks it first.
#pragma once

#include <cstdint>
#include <limits>

#include "core/step/segment.hpp"

namespace lockstep {

/// The longest piece: 2^42 ticks, 51 days of microseconds.
inline constexpr Ticks kMaxPieceTicks{std::int64_t{1} << 42};

/// True if 0 <= ticks <= kMaxPieceTicks and the velocity register never leaves 64 bits, which is half a step per
/// tick either way. Velocity is linear in time, so its two ends decide.
constexpr bool executable(const Piece& piece) {
    if (piece.ticks < Ticks{0} || piece.ticks > kMaxPieceTicks) { return false; }
    const Int128 last = piece.velocity_after(piece.ticks);
    return last >= std::numeric_limits<std::int64_t>::min() && last <= std::numeric_limits<std::int64_t>::max();
}

}  // namespace lockstep
