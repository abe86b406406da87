#include "core/axis/state/followed_play.hpp"

#include <gtest/gtest.h>

#include "core/motion/interpolate.hpp"

namespace lockstep {
namespace {

/// The motor goes up by 9 steps and back by 9 within one piece.
ExecutedTrack turning() {
    constexpr std::int64_t kTicks = 6000;
    constexpr double kAcceleration = 2.0 * 9 / (kTicks / 2.0) / (kTicks / 2.0);
    const Position at = Position::steps(40);
    return {.start = {},
            .from = at,
            .pieces = {solve_piece(at, at, Ticks{kTicks}, -kAcceleration)},
            .stop_count = 40,
            .zero_count = 100,
            .commanded_start = {}};
}

TEST(FollowedPlay, FollowsAPieceInWhichTheMotorTurns) {
    const ExecutedTrack track = turning();
    ASSERT_EQ((track.from + track.pieces[0].covered(Ticks{3000})).count(), 49);
    FollowedPlay down({.steps = 5, .toward_min = true});
    down.follow(track);
    EXPECT_EQ(down.steps(), 0) << "it was at 5 at the turn, and 9 steps back lead through it";
    FollowedPlay up({.steps = 5, .toward_min = false});
    up.begin(-2, 140);
    up.follow(track);
    EXPECT_EQ(up.steps(), -5);
}

TEST(FollowedPlay, CountsWhatIsNotRecordedYetAsOneMotion) {
    FollowedPlay play({.steps = 5, .toward_min = true});
    play.follow(turning());
    EXPECT_EQ(play.at(140), 0);
    EXPECT_EQ(play.at(143), 3);
    EXPECT_EQ(play.at(150), 5);
    EXPECT_EQ(play.steps(), 0);
}

TEST(FollowedPlay, TakesPulsesThatCeasedForOneMotion) {
    FollowedPlay play({.steps = 5, .toward_min = true});
    ExecutedTrack track = turning();
    track.cut = true;
    track.stop_count = 44;
    play.follow(track);
    EXPECT_EQ(play.steps(), 4);
    EXPECT_EQ(play.at(144), 4);
}

}  // namespace
}  // namespace lockstep
