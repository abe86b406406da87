// Coordinated moves by Lai's velocity planner have whole pulses in every period, end exactly, and keep the limits.
#include "core/coordinator/path/lai_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/axis/following/frame_check.hpp"
#include "core/methods/lai_planner.hpp"
#include "core/motion/interpolate.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t kTick_ns = 1000;
constexpr Ticks kPeriod{6500};
constexpr Ticks kLeastMove{400};

/// The start velocity is two pulses per period. A change of one pulse per period takes half the acceleration.
AxisLimits axis_of(double steps_per_s, double acceleration, double deceleration) {
    return {400e-6, steps_per_s * 1e-6, acceleration * 1e-12, deceleration * 1e-12, -1'000'000, 1'000'000};
}
AxisLimits axis_of(double steps_per_s, double steps_per_s2) { return axis_of(steps_per_s, steps_per_s2, steps_per_s2); }
const std::vector<AxisLimits> kLimits(2, axis_of(5000, 60'000));
const std::vector<double> kScale{80, 400};

Path path_through(const std::vector<AxisCounts>& places, LaiFollowing following = LaiFollowing::OnTheLine,
                  const std::vector<AxisLimits>& limits = kLimits, const std::vector<double>& scale = kScale) {
    std::vector<PathMove> moves;
    for (std::size_t i = 1; i < places.size(); ++i) {
        moves.push_back(make_move(places[i - 1], places[i], limits, scale, std::nullopt));
        moves.back().block = static_cast<std::uint32_t>(i);
    }
    return plan_lai_path(moves, {}, limits, scale, kTick_ns, kLeastMove, following);
}

/// Makes one frame of the path up to `end` and a tail behind it. Expects both axes to accept it.
void expect_accepted(const Path& path, Ticks end, const std::vector<AxisLimits>& limits = kLimits) {
    std::vector<Position> at{start_of(path, 0, 0), start_of(path, 1, 0)};
    std::vector<AxisTrack> tracks{{at[0], {}, {}}, {at[1], {}, {}}};
    std::vector<MotionPoint> from{{at[0], 0, {}}, {at[1], 0, {}}};
    std::vector<Piece> pieces(2);
    PieceSource body(path, Ticks{0}, end, at);
    while (body.next(pieces)) {
        for (std::size_t i = 0; i < 2; ++i) { ASSERT_TRUE(tracks[i].body.push_back(pieces[i])); }
    }
    Path tail;
    brake_from(path, subticks(end), limits, tail);
    PieceSource rest(tail, Ticks{0}, tail.duration().ceil(), at);
    while (rest.next(pieces)) {
        for (std::size_t i = 0; i < 2; ++i) { ASSERT_TRUE(tracks[i].tail.push_back(pieces[i])); }
    }
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(check_track(tracks[i], end, false, limits[i], from[i]), FaultCode::None)
            << "axis " << i << ", tail from tick " << end.value << " of " << path.duration().ceil().value;
    }
}

TEST(LaiPath, ThePapersMoveEndsAtMinus93) {
    const Path path = path_through({{0, 0}, {107, -93}});
    EXPECT_EQ(path.moves.back().to, (AxisCounts{107, -93}));
}

TEST(LaiPath, EveryPeriodHasWholePulsesAndThePapersLength) {
    const Path path = path_through({{0, 0}, {107, -93}});
    AxisCounts at{0, 0};
    for (const PathMove& period : path.moves) {
        EXPECT_EQ(period.from, at);
        EXPECT_EQ(period.profile.duration(), subticks(kPeriod));
        at = period.to;
    }
}

TEST(LaiPath, SpeedChangesByAtMostOnePulsePerPeriod) {
    const Path path = path_through({{0, 0}, {107, 0}});
    std::int64_t before = 0;
    for (const PathMove& period : path.moves) {
        EXPECT_LE(std::abs(period.lead - before), 1);
        before = period.lead;
    }
    EXPECT_EQ(std::max_element(path.moves.begin(), path.moves.end(),
                               [](const PathMove& a, const PathMove& b) { return a.lead < b.lead; })
                  ->lead,
              10);  // floor(sqrt(107))
}

/// The greatest velocity of the axis is 32.5 pulses per period.
TEST(LaiPath, ALongMoveGoesAsFastAsWholePulsesAllow) {
    const Path path = path_through({{0, 0}, {4000, 0}});
    std::int64_t fastest = 0;
    for (const PathMove& period : path.moves) { fastest = std::max(fastest, period.lead); }
    EXPECT_EQ(fastest, 32);
}

TEST(LaiPath, AShortAxisKeepsItsGreatestVelocityWithItsRoundedPulses) {
    const std::vector<AxisLimits> limits{axis_of(5000, 60'000), axis_of(2500, 60'000)};  // 32.5 and 16.25 per period
    const PathMove move = make_move({0, 0}, {4000, 3600}, limits, kScale, std::nullopt);
    const Path path = plan_lai_path({move}, {}, limits, kScale, kTick_ns, kLeastMove);
    for (const PathMove& period : path.moves) {
        EXPECT_LE(period.to[1] - period.from[1], 16);
        EXPECT_LE(std::abs(static_cast<double>(period.to[1]) - 0.9 * static_cast<double>(period.to[0])), 0.5 + 1e-9);
    }
    EXPECT_EQ(path.moves.back().to, (AxisCounts{4000, 3600}));
}

TEST(LaiPath, ShortAxesAreOnTheLineToTheNearestStep) {
    std::mt19937_64 random(7);
    const auto length = [&] { return static_cast<std::int64_t>(random() % 4001) - 2000; };
    for (int run = 0; run < 200; ++run) {
        const AxisCounts to{length(), length()};
        if (to[0] == 0 && to[1] == 0) { continue; }
        const std::size_t lead = std::abs(to[0]) >= std::abs(to[1]) ? 0 : 1;
        const Path path = path_through({{0, 0}, to});
        for (const PathMove& period : path.moves) {
            const double share = static_cast<double>(to[1 - lead]) / static_cast<double>(to[lead]);
            const double off = static_cast<double>(period.to[1 - lead]) - share * static_cast<double>(period.to[lead]);
            EXPECT_LE(std::abs(off), 0.5 + 1e-9) << to[0] << ", " << to[1];
        }
    }
}

TEST(LaiPath, EveryFrameAndEveryTailKeepsTheLimits) {
    for (const LaiFollowing following : {LaiFollowing::OnTheLine, LaiFollowing::AsPublished}) {
        const Path path = path_through({{0, 0}, {40, 31}, {37, 60}, {-20, 60}, {-20, 58}, {20, 0}}, following);
        ASSERT_LT(path.moves.size(), kMaxBodyPieces);
        for (Ticks end{1}; end < path.duration().floor(); end += Ticks{97}) { expect_accepted(path, end); }
    }
}

TEST(LaiPath, TailsKeepADecelerationThatDiffersFromTheAcceleration) {
    for (const auto& [acceleration, deceleration] : {std::pair{90'000, 60'000}, {60'000, 90'000}}) {
        const std::vector<AxisLimits> limits(2, axis_of(5000, acceleration, deceleration));
        const Path path = path_through({{0, 0}, {40, 31}, {37, 60}, {-20, 58}}, LaiFollowing::OnTheLine, limits);
        for (Ticks end{1}; end < path.duration().floor(); end += Ticks{97}) { expect_accepted(path, end, limits); }
    }
}

/// A pulse of the short axis is as long as a thousand of the long one.
TEST(LaiPath, TailsKeepTheLimitsWithStepsOfVeryDifferentLengths) {
    const std::vector<double> scale{80, 0.08};
    const Path path = path_through({{0, 0}, {700, 60}, {0, -40}, {90, 50}}, LaiFollowing::OnTheLine, kLimits, scale);
    ASSERT_LT(path.moves.size(), kMaxBodyPieces);
    for (Ticks end{1}; end < path.duration().floor(); end += Ticks{97}) { expect_accepted(path, end); }
}

TEST(LaiPath, AsPublishedIsThePapersPlanPeriodForPeriod) {
    std::mt19937_64 random(11);
    const auto length = [&] { return static_cast<std::int64_t>(random() % 401) - 200; };
    for (int run = 0; run < 200; ++run) {
        const AxisCounts to{length(), length()};
        if (to[0] == 0 && to[1] == 0) { continue; }
        const Path path = path_through({{0, 0}, to}, LaiFollowing::AsPublished);
        const auto papers = methods::plan_two_axes({to[0], to[1]}, {.max = 31}, methods::LaiRounding::InEachPeriod, {});
        ASSERT_EQ(path.moves.size(), papers.size()) << to[0] << ", " << to[1];
        for (std::size_t i = 0; i < papers.size(); ++i) {
            const PathMove& period = path.moves[i];
            EXPECT_EQ(period.to[0] - period.from[0], papers[i].x) << i;
            EXPECT_EQ(period.to[1] - period.from[1], papers[i].y) << i;
        }
        EXPECT_EQ(path.moves.back().to, to);
    }
}

TEST(LaiPath, HeldMoveContinuesFromRestToItsTarget) {
    const Path whole = path_through({{0, 0}, {107, -93}, {0, 0}});
    for (std::size_t held = 1; held < whole.moves.size(); ++held) {
        const std::vector<PathMove> left(whole.moves.begin() + static_cast<std::ptrdiff_t>(held), whole.moves.end());
        const Displacement along{Displacement::steps(left.front().lead).raw / 3};
        const Path rest = plan_lai_path(left, along, kLimits, kScale, kTick_ns, kLeastMove);
        EXPECT_EQ(rest.moves.front().from, left.front().from);
        EXPECT_EQ(rest.moves.front().to, left.front().to);
        EXPECT_EQ(rest.moves.back().to, (AxisCounts{0, 0}));
        for (std::size_t i = 1; i < rest.moves.size(); ++i) { EXPECT_EQ(rest.moves[i].from, rest.moves[i - 1].to); }
    }
}

TEST(LaiPath, NoPeriodChangesTheSpeedByMoreThanItMay) {
    for (std::int64_t change = 1; change < 9; ++change) {
        for (std::int64_t length = 1; length < 1000; ++length) {
            std::int64_t before = 0;
            std::int64_t sum = 0;
            methods::LaiLongAxis axis(length, {.max = 60, .change = change}, methods::LaiLeftOver::WithinTheFall);
            while (axis.remaining() > 0) {
                const std::int64_t pulses = axis.next();
                ASSERT_LE(std::abs(pulses - before), change) << length << " by " << change;
                before = pulses;
                sum += pulses;
            }
            ASSERT_EQ(sum, length);
            ASSERT_LE(before, change) << length << " by " << change;
        }
    }
}

MachineConfig machine_of(double start_mm_s, double accel_mm_s2) {
    MachineConfig machine{.name = "lai", .coordination = StepMethod::Lai};
    machine.axes.assign(2, {.name = "X",
                            .steps_per_mm = 80,
                            .start_velocity_mm_s = start_mm_s,
                            .max_velocity_mm_s = 50,
                            .max_accel_mm_s2 = accel_mm_s2,
                            .max_decel_mm_s2 = accel_mm_s2});
    return machine;
}

TEST(LaiPath, AMachineThatCannotChangeSpeedByWholePulsesIsRefused) {
    EXPECT_TRUE(suits_lai_path(machine_of(5, 800)).has_value());
    EXPECT_TRUE(suits_lai_path(machine_of(2 / 80. / 6.5e-3, 2 / 80. / 6.5e-3 / 6.5e-3)).has_value())
        << "exactly enough";
    EXPECT_NE(text_of(suits_lai_path(machine_of(3, 800)).error()).find("start_velocity_mm_s must be at least 3.84615"),
              std::string::npos);
    EXPECT_NE(text_of(suits_lai_path(machine_of(5, 500)).error()).find("max_accel_mm_s2 must be at least 591.715976"),
              std::string::npos);
    MachineConfig one = machine_of(5, 800);
    one.axes.pop_back();
    EXPECT_FALSE(suits_lai_path(one).has_value());
}

TEST(LaiPath, FramesThatCarryOneMoveEachPeriodAreShortEnoughAndLongerOnesAreNot) {
    MachineConfig machine = machine_of(5, 800);
    machine.timing.frame_slots = 5;
    machine.timing.slot_us = 15'599;
    ASSERT_EQ(least_move(machine), kPeriod);
    EXPECT_TRUE(suits_lai_path(machine).has_value());
    machine.timing.slot_us = 15'601;
    ASSERT_GT(least_move(machine), kPeriod);
    EXPECT_NE(text_of(suits_lai_path(machine).error()).find("lower timing.frame_slots"), std::string::npos);
}

TEST(LaiPath, AFeedBelowOnePulsePerPeriodIsRefused) {
    const auto checked = [](double feed_mm_s) {
        return check_lai_move(make_move({0, 0}, {800, 0}, kLimits, kScale, feed_mm_s * 1e-6), kTick_ns);
    };
    EXPECT_TRUE(checked(2).has_value());
    EXPECT_NEAR(checked(1).error(), 1.92308, 1e-5);
}

}  // namespace
}  // namespace lockstep
