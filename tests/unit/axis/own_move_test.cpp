// The frames of an own move join each other and end on the last step. The axis can come to rest from each of them.
#include "core/axis/own_moves/own_move.hpp"
#include "core/kinematics/motors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/axis/following/frame_check.hpp"
#include "core/methods/paper_steps.hpp"
#include "core/program.hpp"
#include "core/step/engine.hpp"

namespace lockstep {
namespace {

/// An axis of 80 steps/mm, as fast as the method allows.
MotorConfig axis_by(StepMethod method) {
    MotorConfig axis{.name = "X",
                     .steps_per_mm = 80,
                     .start_velocity_mm_s = 10,
                     .max_velocity_mm_s = 150,
                     .max_accel_mm_s2 = 1500,
                     .max_decel_mm_s2 = 1500,
                     .position_max_mm = 200,
                     .method = method};
    if (method == StepMethod::Lai) { axis.max_velocity_mm_s = 50; }
    if (method == StepMethod::Lam) { axis.max_velocity_mm_s = 20; }
    return axis;
}

struct ByMethod : testing::TestWithParam<StepMethod> {
    static constexpr Ticks kSpan{12'000};
    static constexpr Tick kStart{5'000};

    OwnMove move(std::int64_t steps, bool backward) const {
        const OwnMoveRequest request{steps, axis.max_velocity_mm_s};
        return OwnMove(OwnPieces::plan(axis, 1000, GetParam(), request, methods::begin_steps).value(),
                       {rest_position(0, backward), backward, steps, kStart}, limits, {kSpan, kSpan});
    }
    MotorConfig axis = axis_by(GetParam());
    AxisLimits limits = limits_of(axis, 1000);
};

TEST_P(ByMethod, FramesJoinEachOtherAndEndOnTheLastStep) {
    for (const std::int64_t steps : {1, 2, 3, 10, 777, 12'000}) {
        for (const bool backward : {false, true}) {
            OwnMove frames = move(steps, backward);
            Position at = rest_position(0, backward);
            Tick now = kStart;
            FrameNumber number = 0;
            bool ended = false;
            while (!frames.all_made()) {
                const HeldFrame frame = frames.next();
                EXPECT_EQ(frame.number, ++number);
                EXPECT_EQ(frame.start, now);
                EXPECT_EQ(frame.track.from, at);
                EXPECT_FALSE(ended);
                now = frame.end();
                at = frame.body_end();
                ended = frame.last;
            }
            EXPECT_TRUE(ended && !frames.broken());
            EXPECT_EQ(frames.end(), now);
            EXPECT_EQ(at.count(), backward ? -steps : steps);
            EXPECT_NEAR(at.as_steps(), static_cast<double>(at.count()), 1e-9);
        }
    }
}

TEST_P(ByMethod, EveryTailRestsWithinTheLimitsAndNotBeyondTheMove) {
    for (const std::int64_t steps : {2, 3, 10, 55, 200, 777, 12'000}) {
        OwnMove frames = move(steps, false);
        while (!frames.all_made()) {
            const HeldFrame frame = frames.next();
            if (frame.last) { break; }
            ASSERT_EQ(frame.track.tail.size(), 1u);
            const Piece& tail = frame.track.tail.front();
            const Piece& before = frame.track.body.back();
            const double a = tail.acceleration.steps_per_tick2();
            const double entry = tail.velocity.steps_per_tick() + a / 2;
            const double exit = entry + a * static_cast<double>(tail.ticks.value);
            const double speed = static_cast<double>(before.velocity_after(before.ticks)) * 0x1p-64;
            const double some = 0.03 * limits.start_velocity;  // the effect of rounding to whole ticks
            EXPECT_LE(-a, limits.max_deceleration * 1.001) << frame.number;
            EXPECT_LE(a, 0) << frame.number;
            EXPECT_LE(std::abs(speed - entry), limits.start_velocity + some) << frame.number;
            EXPECT_LE(exit, limits.start_velocity + some) << frame.number;
            if (GetParam() == StepMethod::Ranade) { EXPECT_LE(speed - entry, some) << "it slows at once"; }
            const Position rest = frame.body_end() + tail.covered();
            EXPECT_LE(rest.count(), steps);
            EXPECT_NEAR(rest.as_steps(), static_cast<double>(rest.count()), 1e-9);
        }
    }
}

TEST_P(ByMethod, FramesAndTailsAreShortAtEverySpeed) {
    constexpr std::int64_t kSteps = 40;
    int speeds = 0;
    for (double speed_mm_s = kLeastSpeed_mm_s; speed_mm_s < axis.max_velocity_mm_s; speed_mm_s *= 10) {
        auto pieces = OwnPieces::plan(axis, 1000, GetParam(), {kSteps, speed_mm_s}, methods::begin_steps);
        if (!pieces) { continue; }  // a method may have a greater least speed; the axis then uses Ranade's
        ++speeds;
        const double least_ticks = 1e6 / (speed_mm_s * axis.steps_per_mm);
        OwnMove frames(std::move(*pieces), {rest_position(0, false), false, kSteps, kStart}, limits, {kSpan, kSpan});
        for (int k = 0; k < 300 && !frames.all_made(); ++k) {
            const HeldFrame frame = frames.next();
            EXPECT_LE(frame.ticks.value, 3 * kSpan.value) << speed_mm_s;
            const double braking = limits.start_velocity / limits.max_deceleration + 4;
            EXPECT_LE(static_cast<double>(total_ticks(frame.track.tail).value),
                      braking + static_cast<double>(kSpan.value) + std::min(least_ticks, 1.0 * kSpan.value))
                << speed_mm_s << " frame " << frame.number;
        }
    }
    EXPECT_GT(speeds, 0);
}

TEST_P(ByMethod, ACutBetweenTwoStepsChangesNoStep) {
    for (const double speed_mm_s : {0.02, 0.3, 5.0}) {
        const auto steps_cut_after = [&](Ticks most) {
            std::vector<Tick> steps;
            auto pieces = OwnPieces::plan(axis, 1000, GetParam(), {60, speed_mm_s}, methods::begin_steps);
            if (!pieces) { return steps; }
            StepEngine engine(Tick{}, rest_position(0, false));
            while (const auto piece = pieces->next(most)) {
                EXPECT_LE(piece->ticks, most + most);
                engine.begin(*piece);
                engine.run(engine.now() + piece->ticks, [&](StepEdge edge) { steps.push_back(edge.tick); });
            }
            EXPECT_EQ(steps.size(), 60u);
            return steps;
        };
        EXPECT_EQ(steps_cut_after(Ticks{5'000}), steps_cut_after(Ticks{100'000'000})) << speed_mm_s;
    }
}

INSTANTIATE_TEST_SUITE_P(All, ByMethod,
                         testing::Values(StepMethod::Ranade, StepMethod::Spielauer, StepMethod::Lai, StepMethod::Lam,
                                         StepMethod::Carrica),
                         [](const auto& method) { return std::string(name_of(method.param)); });

TEST(OwnPieces, StopBeforeAPieceThatBreaksTheLimits) {
    MotorConfig axis = axis_by(StepMethod::Lam);
    axis.max_velocity_mm_s = 100;
    const AxisLimits limits = limits_of(axis, 1000);
    auto pieces = OwnPieces::plan(axis, 1000, StepMethod::Lam, {1'000, axis.max_velocity_mm_s}, methods::begin_steps);
    ASSERT_TRUE(pieces);
    OwnMove frames(std::move(*pieces), {rest_position(0, false), false, 1'000, Tick{0}}, limits,
                   {Ticks{12'000}, Ticks{12'000}});
    Position rest;
    while (!frames.all_made()) {
        const HeldFrame frame = frames.next();
        EXPECT_FALSE(frame.last);
        rest = frame.body_end();
        for (const Piece& piece : frame.track.tail) { rest = rest + piece.covered(); }
    }
    EXPECT_TRUE(frames.broken());
    EXPECT_LT(rest.count(), 1'000);
    EXPECT_NEAR(rest.as_steps(), static_cast<double>(rest.count()), 1e-9);
}

TEST(OwnPieces, OnlyRanadeMovesInAGivenTime) {
    EXPECT_TRUE(OwnPieces::plan(axis_by(StepMethod::Ranade), 1000, StepMethod::Ranade, {80, 150, Ticks{100'000}},
                                methods::begin_steps));
    const auto other = OwnPieces::plan(axis_by(StepMethod::Lai), 1000, StepMethod::Lai, {80, 50, Ticks{100'000}},
                                       methods::begin_steps);
    ASSERT_FALSE(other);
    EXPECT_EQ(std::get<NotInTime>(other.error()).method, StepMethod::Lai);
}

TEST(OwnPieces, RefuseATimeThatWouldBeTooSlow) {
    const MotorConfig axis = axis_by(StepMethod::Ranade);
    const auto in_s = [&](double seconds) {
        const OwnMoveRequest request{4, 150, Ticks{static_cast<std::int64_t>(seconds * 1e6)}};  // 0.05 mm
        const auto pieces = OwnPieces::plan(axis, 1000, StepMethod::Ranade, request, methods::begin_steps);
        return pieces ? std::string() : text_of(pieces.error(), axis, 1000, request);
    };
    EXPECT_EQ(in_s(600), "");
    EXPECT_EQ(in_s(4'999), "");
    EXPECT_EQ(in_s(5'001), "axis X would be slower than 1e-05 mm/s: 0.05 mm may take at most 5000 s");
}

}  // namespace
}  // namespace lockstep
