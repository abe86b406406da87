// Which tracks of a frame an axis accepts, and the exact place of each limit.
#include "core/axis/following/frame_check.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lockstep {
namespace {

constexpr AxisLimits kLimits{.start_velocity = 1e-3,
                             .max_velocity = 1e-2,
                             .max_acceleration = 4e-6,
                             .max_deceleration = 1e-6,
                             .min_steps = -50,
                             .max_steps = 50};

Velocity velocity(double steps_per_tick) { return {std::llround(steps_per_tick * 0x1p64)}; }
Acceleration acceleration(double steps_per_tick2) { return {std::llround(steps_per_tick2 * 0x1p64)}; }

/// A piece that goes from one speed to another.
Piece piece(double before, double after, std::int64_t ticks) {
    const double a = (after - before) / static_cast<double>(ticks);
    return {{ticks}, velocity(before - a / 2), acceleration(a)};
}

AxisTrack track_of(std::initializer_list<Piece> body, std::initializer_list<Piece> tail = {},
                   Position from = Position::steps(0)) {
    AxisTrack track{.from = from, .body = {}, .tail = {}};
    for (const Piece& p : body) { (void)track.body.push_back(p); }
    for (const Piece& p : tail) { (void)track.tail.push_back(p); }
    return track;
}

/// The result for a track that the axis begins with the speed `begin`.
FaultCode check(const AxisTrack& track, double begin = 0, bool last = false, const AxisLimits& limits = kLimits) {
    MotionPoint from{track.from, begin, {}};
    return check_track(track, total_ticks(track.body), last, limits, from);
}

TEST(FrameCheck, LimitsDecelerationByTheDecelerationAlone) {
    const Piece slows_down = piece(4e-3, 2e-3, 1000);  // 2e-6: above the deceleration, below the acceleration
    EXPECT_EQ(check(track_of({slows_down}, {piece(2e-3, 0, 2000)}), 4e-3), FaultCode::FrameBeyondLimits);
    EXPECT_EQ(check(track_of({piece(4e-3, 2e-3, 2000)}, {piece(2e-3, 0, 2000)}), 4e-3), FaultCode::None);
    const Piece backward = piece(-4e-3, -2e-3, 1000);
    EXPECT_EQ(check(track_of({backward}, {piece(-2e-3, 0, 2000)}), -4e-3), FaultCode::FrameBeyondLimits);
}

TEST(FrameCheck, LimitsAccelerationByTheAccelerationAlone) {
    const Piece speeds_up = piece(0, 2e-3, 1000);  // 2e-6: above the deceleration, below the acceleration
    EXPECT_EQ(check(track_of({speeds_up}, {piece(2e-3, 0, 2000)})), FaultCode::None);
    AxisLimits weak = kLimits;
    weak.max_acceleration = 1e-6;
    weak.max_deceleration = 4e-6;
    EXPECT_EQ(check(track_of({speeds_up}, {piece(2e-3, 0, 2000)}), 0, false, weak), FaultCode::FrameBeyondLimits);
}

TEST(FrameCheck, LimitsTheSpeedAtBothEndsOfAPiece) {
    AxisLimits wide = kLimits;
    wide.min_steps = -1'000'000;
    wide.max_steps = 1'000'000;
    const Piece stop = piece(1e-2, 0, 10'000);
    EXPECT_EQ(check(track_of({piece(9e-3, 1e-2, 1000)}, {stop}), 9e-3, false, wide), FaultCode::None);
    EXPECT_EQ(check(track_of({piece(9e-3, 1.002e-2, 1000)}, {piece(1.002e-2, 0, 10'020)}), 9e-3, false, wide),
              FaultCode::FrameBeyondLimits);
    EXPECT_EQ(check(track_of({piece(1.002e-2, 1e-2, 1000)}, {stop}), 1.002e-2, false, wide),
              FaultCode::FrameBeyondLimits);
    EXPECT_EQ(check(track_of({piece(-9e-3, -1.002e-2, 1000)}, {piece(-1.002e-2, 0, 10'020)}), -9e-3, false, wide),
              FaultCode::FrameBeyondLimits);
}

TEST(FrameCheck, LimitsAJumpBetweenPiecesToTheStartVelocity) {
    EXPECT_EQ(check(track_of({piece(9.9e-4, 9.9e-4, 1000)})), FaultCode::None);
    EXPECT_EQ(check(track_of({piece(1.02e-3, 1.02e-3, 1000)})), FaultCode::FrameBeyondLimits) << "out of rest";
    EXPECT_EQ(check(track_of({piece(-9e-4, -9e-4, 1000), piece(9e-4, 9e-4, 1000)})), FaultCode::FrameBeyondLimits);
    EXPECT_EQ(check(track_of({piece(5e-4, 5e-4, 1000)}, {}), 2e-3), FaultCode::FrameBeyondLimits) << "from before";
}

TEST(FrameCheck, RefusesATrackThatEndsTooFastToRest) {
    EXPECT_EQ(check(track_of({piece(0, 9.9e-4, 1000)})), FaultCode::None);
    EXPECT_EQ(check(track_of({piece(0, 1.1e-3, 1000)})), FaultCode::FrameBeyondLimits);
    EXPECT_EQ(check(track_of({piece(0, -1.1e-3, 1000)})), FaultCode::FrameBeyondLimits);
    EXPECT_EQ(check(track_of({piece(0, 2e-3, 1000)}, {piece(2e-3, 1.1e-3, 900)})), FaultCode::FrameBeyondLimits);
}

TEST(FrameCheck, AcceptsTravelUpToBothEndsAndNoFurther) {
    const auto end_at = [](std::int64_t from, std::int64_t to) {
        constexpr std::int64_t kTicks = 100'000;
        const Position begin = Position::steps(from);
        const Piece piece{{kTicks}, {static_cast<std::int64_t>(Displacement::steps(to - from).raw / kTicks)}, {0}};
        return check(track_of({piece}, {}, begin));
    };
    EXPECT_EQ(end_at(0, 50), FaultCode::None);
    EXPECT_EQ(end_at(0, 51), FaultCode::FrameOutsideTravel);
    EXPECT_EQ(end_at(0, -50), FaultCode::None);
    EXPECT_EQ(end_at(0, -51), FaultCode::FrameOutsideTravel);
}

TEST(FrameCheck, ChecksTheTravelOfTheTailToo) {
    const AxisTrack beyond = track_of({piece(9e-4, 9e-4, 50'000)}, {piece(9e-4, 9e-4, 10'000)});
    EXPECT_EQ(check(beyond), FaultCode::FrameOutsideTravel) << "45 steps in the body, 9 more in the tail";
}

TEST(FrameCheck, RefusesPiecesWithoutLengthOrTooLongForExactArithmetic) {
    constexpr std::int64_t kLongest = std::int64_t{1} << 42;
    EXPECT_EQ(check(track_of({{{0}, {}, {}}})), FaultCode::BadProgram);
    EXPECT_EQ(check(track_of({{{-1}, {}, {}}})), FaultCode::BadProgram);
    EXPECT_EQ(check(track_of({{{1}, {}, {}}})), FaultCode::None);
    EXPECT_EQ(check(track_of({{{kLongest}, {}, {}}})), FaultCode::None);
    EXPECT_EQ(check(track_of({{{kLongest + 1}, {}, {}}})), FaultCode::BadProgram);
}

TEST(FrameCheck, RefusesABodyOfAnotherLengthAndATailBehindTheLastFrame) {
    const AxisTrack track = track_of({piece(5e-4, 5e-4, 1000)});
    MotionPoint from{track.from, 0, {}};
    EXPECT_EQ(check_track(track, {999}, false, kLimits, from), FaultCode::BadProgram);
    EXPECT_EQ(check_track(track, {1001}, false, kLimits, from), FaultCode::BadProgram);
    const AxisTrack with_tail = track_of({piece(5e-4, 5e-4, 1000)}, {piece(5e-4, 0, 1000)});
    EXPECT_EQ(check(with_tail, 0, false), FaultCode::None);
    EXPECT_EQ(check(with_tail, 0, true), FaultCode::BadProgram);
    EXPECT_EQ(check(track, 0, true), FaultCode::None);
}

TEST(FrameCheck, RefusesATrackFromElsewhereAndLeavesThePointAsItIs) {
    const AxisTrack track = track_of({piece(5e-4, 5e-4, 1000)});
    MotionPoint from{track.from + Displacement{1}, 0, {}};
    const Position before = from.position;
    EXPECT_EQ(check_track(track, {1000}, false, kLimits, from), FaultCode::FrameDiscontinuous);
    EXPECT_EQ(from.position, before);
}

TEST(FrameCheck, GivesThePointAtTheEndOfTheBodyForTheNextFrame) {
    const AxisTrack track = track_of({piece(0, 2e-3, 1000)}, {piece(2e-3, 0, 2000)});
    MotionPoint point{track.from, 0, {}};
    ASSERT_EQ(check_track(track, {1000}, false, kLimits, point), FaultCode::None);
    EXPECT_EQ(point.position, track.from + track.body[0].covered());
    EXPECT_NEAR(point.velocity, 2e-3, 1e-12);
    EXPECT_EQ(check(track_of({piece(5e-3, 5e-3, 1000)}, {piece(5e-3, 0, 5000)}), 2e-3), FaultCode::FrameBeyondLimits);
}

}  // namespace
}  // namespace lockstep
