// A piece is solved for its end: the velocity is rounded to the nearest unit per tick.
#include <gtest/gtest.h>

#include <limits>

#include "core/motion/interpolate.hpp"

namespace lockstep {
namespace {

std::int64_t velocity_for(std::int64_t units, std::int64_t ticks, double acceleration = 0) {
    const Position from = Position::steps(3);
    return solve_piece(from, from + Displacement{units}, {ticks}, acceleration).velocity.raw;
}

TEST(SolvePiece, RoundsTheVelocityToTheNearestUnit) {
    EXPECT_EQ(velocity_for(4, 3), 1);
    EXPECT_EQ(velocity_for(5, 3), 2);
    EXPECT_EQ(velocity_for(6, 3), 2);
    EXPECT_EQ(velocity_for(7, 3), 2);
    EXPECT_EQ(velocity_for(3, 2), 2) << "a half goes away from zero";
}

TEST(SolvePiece, RoundsBackwardMotionAsItsMirrorImage) {
    EXPECT_EQ(velocity_for(0, 3), 0);
    for (const std::int64_t units : {1, 4, 5, 6, 7, 1001}) {
        EXPECT_EQ(velocity_for(-units, 3), -velocity_for(units, 3)) << units;
    }
}

TEST(SolvePiece, EndsWithinHalfAUnitPerTickOfItsTarget) {
    for (const std::int64_t ticks : {1, 2, 7, 1000}) {
        for (const double acceleration : {0.0, 3e-9, -3e-9}) {
            const Position from = Position::steps(-2);
            const Position to = from + Displacement{Int128{123'456'789'012'345'677} * 11};
            const Displacement missed = from + solve_piece(from, to, {ticks}, acceleration).covered() - to;
            EXPECT_LE(2 * (missed.raw < 0 ? -missed.raw : missed.raw), ticks) << ticks << ", " << acceleration;
        }
    }
}

TEST(SolvePiece, TakesTheAccelerationAsItIsGiven) {
    EXPECT_EQ(solve_piece({}, {}, {10}, 0x1p-40).acceleration.raw, std::int64_t{1} << 24);
    EXPECT_EQ(solve_piece({}, {}, {10}, -0x1p-40).acceleration.raw, -(std::int64_t{1} << 24));
    EXPECT_EQ(velocity_for(0, 3, 0x1p-63), -4) << "(1 + 2 + 3) * 2 units are taken back in 3 ticks";
}

TEST(SolvePiece, KeepsAVelocityThatNoRegisterHoldsAtTheLargest) {
    const Position far = Position::steps(10);
    EXPECT_EQ(solve_piece({}, far, {1}, 0).velocity.raw, std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ(solve_piece(far, {}, {1}, 0).velocity.raw, -std::numeric_limits<std::int64_t>::max());
}

}  // namespace
}  // namespace lockstep
