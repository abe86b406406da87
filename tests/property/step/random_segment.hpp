// Segments of every kind that an engine may receive, from a seed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>

#include "core/step/executable.hpp"
#include "core/step/segment.hpp"

namespace lockstep::testing {

class RandomSegments {
public:
    explicit RandomSegments(std::uint64_t seed) : random_(seed) {}

    /// Durations are 1 ... 2^ticks_bits; short ones are as likely as long ones.
    Segment next(int ticks_bits) {
        Segment segment{Tick{below(1'000'000)}, start(), Piece{ticks(ticks_bits), {}, {}}};
        shape(segment.piece);
        while (!executable(segment.piece)) { segment.piece.ticks.value /= 2; }
        segment.piece.ticks = std::max(segment.piece.ticks, Ticks{1});
        if (!executable(segment.piece)) { segment.piece.acceleration.raw = 0; }
        if (one_in(8)) { aim_at_a_tie(segment); }
        return segment;
    }

    /// 0 ... bound - 1.
    std::int64_t below(std::int64_t bound) {
        return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(bound));
    }
    bool one_in(std::int64_t n) { return below(n) == 0; }

private:
    /// A number of either sign; every number of bits is equally likely.
    std::int64_t any_size(int bits) {
        const auto magnitude = static_cast<std::int64_t>(random_() >> (64 - 1 - below(bits)) >> 1);
        return one_in(2) ? magnitude : -magnitude;
    }
    Ticks ticks(int bits) { return {1 + static_cast<std::int64_t>(random_() >> 1 >> (63 - below(bits + 1)))}; }
    Position start() {
        constexpr std::uint64_t kCorners[] = {0, 1, kRestPhase - 1, kRestPhase, kRestPhase + 1, ~std::uint64_t{0}};
        return Position::from_count(any_size(40), one_in(4) ? kCorners[below(6)] : random_());
    }
    /// Any size, or a size that makes steps within a thousand ticks, or a fraction with a small denominator, rounded
    /// down, as an engineer would choose.
    std::int64_t speed() {
        switch (below(4)) {
            case 0: return any_size(64);
            case 1: return std::numeric_limits<std::int64_t>::max() / (1 + below(1000));
            default: return (one_in(2) ? 1 : -1) * static_cast<std::int64_t>(random_() >> 1 >> below(11));
        }
    }
    void shape(Piece& piece) {
        const std::int64_t first = speed();
        piece.velocity.raw = one_in(2) ? first : -first;
        switch (below(8)) {
            case 0: piece.acceleration.raw = 0; break;
            case 1: piece.acceleration.raw = any_size(64); break;
            default:  // from one speed to another, through rest or not
                const Int128 change = Int128{one_in(4) ? -first : speed()} - piece.velocity.raw;
                piece.acceleration.raw = static_cast<std::int64_t>(change / piece.ticks.value);
        }
    }
    /// Moves the start so that some tick ends on a step's threshold exactly, or one unit beside it.
    void aim_at_a_tie(Segment& segment) {
        const Ticks n{1 + below(segment.piece.ticks.value)};
        const auto travelled = static_cast<std::uint64_t>(segment.piece.covered(n).raw);
        segment.from =
            Position::from_count(segment.from.count(), 0 - travelled + static_cast<std::uint64_t>(below(3) - 1));
    }

    std::mt19937_64 random_;
};

}  // namespace lockstep::testing
