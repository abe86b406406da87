// From every tick of a path there is a tail that every axis accepts: also just before, in and just after a corner.
#include <gtest/gtest.h>

#include <cmath>

#include "core/axis/following/frame_check.hpp"
#include "core/motion/interpolate.hpp"
#include "core/motion/lookahead.hpp"
#include "tests/unit/motion/scale.hpp"

namespace lockstep {
namespace {

template <std::size_t Capacity>
void fill(StaticVector<Piece, Capacity> AxisTrack::*part, const Path& path, Ticks begin, Ticks end,
          std::vector<Position>& at, std::vector<AxisTrack>& tracks) {
    std::vector<Piece> pieces(at.size());
    PieceSource source(path, begin, end, at);
    while (source.next(pieces)) {
        for (std::size_t i = 0; i < at.size(); ++i) { ASSERT_TRUE((tracks[i].*part).push_back(pieces[i])); }
    }
}

/// Runs the path to `end` as one frame, with the tail after it, and checks it on every axis.
void expect_accepted(const Path& path, Ticks end, const std::vector<AxisLimits>& limits) {
    std::vector<Position> at{start_of(path, 0, path.moves[0].from[0]), start_of(path, 1, path.moves[0].from[1])};
    std::vector<AxisTrack> tracks{{at[0], {}, {}}, {at[1], {}, {}}};
    std::vector<MotionPoint> from{{at[0], 0, {}}, {at[1], 0, {}}};
    fill(&AxisTrack::body, path, Ticks{0}, end, at, tracks);
    const Path tail = brake_from(path, subticks(end), limits);
    if (!tail.empty()) { fill(&AxisTrack::tail, tail, Ticks{0}, tail.duration().ceil(), at, tracks); }
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(check_track(tracks[i], end, false, limits[i], from[i]), FaultCode::None)
            << "axis " << i << ", tail from tick " << end.value << " of " << path.duration().ceil().value;
    }
}

void expect_accepted_everywhere(double acceleration, double deceleration) {
    const std::vector<AxisLimits> limits(2, {1e-3, 0.02, acceleration, deceleration, -1'000'000, 1'000'000});
    for (std::int64_t first = 40; first < 50; ++first) {
        const std::vector<AxisCounts> places{{0, 0}, {first, 1}, {first + 60, 0}, {first + 61, 3}, {first, 30}};
        std::vector<PathMove> moves;
        for (std::uint32_t i = 1; i < places.size(); ++i) {
            moves.push_back(make_move(places[i - 1], places[i], limits, kScale, 0));
            moves.back().block = i;
        }
        const Path path = plan_path(moves, {}, limits, {.least_move = Ticks{100}});
        const Ticks stride{path.duration().floor().value / 4000 + 1};
        for (Ticks end{1}; end < path.duration().floor(); end += stride) { expect_accepted(path, end, limits); }
    }
}

TEST(Tail, IsAcceptedFromEverywhereOnAFinelyCutCurve) {
    const std::vector<AxisLimits> limits(2, {5e-4, 0.01, 1e-7, 1e-7, -1'000'000, 1'000'000});
    std::vector<PathMove> moves;
    AxisCounts at{600, 0};
    for (std::uint32_t i = 1; i <= 40; ++i) {
        const double angle = 0.05 * i;
        const AxisCounts to{std::llround(600 * std::cos(angle)), std::llround(600 * std::sin(angle))};
        moves.push_back(make_move(at, to, limits, kScale, 0));
        moves.back().block = i;
        at = to;
    }
    const Path path = plan_path(moves, {}, limits, {.least_move = Ticks{100}});
    const Ticks stride{path.duration().floor().value / 1000};
    for (Ticks end{1}; end < path.duration().floor(); end += stride) { expect_accepted(path, end, limits); }
}

TEST(Tail, IsAcceptedFromTheLastTicksBeforeACornerOfASlowAxis) {
    const std::vector<AxisLimits> limits(2, {1.9e-3, 1.9e-3, 3.7e-10, 3.7e-10, -1'000'000, 1'000'000});
    for (std::int64_t first = 480; first < 500; ++first) {
        std::vector<PathMove> moves{make_move({0, 0}, {first, 80}, limits, kScale, 1.2e-5),
                                    make_move({first, 80}, {900, 20}, limits, kScale, 2e-6)};
        moves[1].block = 1;
        const Path path = plan_path(moves, {}, limits, {.least_move = Ticks{100}});
        const Ticks corner = path.moves[0].end().floor();
        for (Ticks end = corner - Ticks{20}; end <= corner; end += Ticks{1}) { expect_accepted(path, end, limits); }
    }
}

TEST(Tail, IsAcceptedFromEveryTickOfAPath) { expect_accepted_everywhere(1e-7, 1e-7); }

TEST(Tail, IsAcceptedWhereBrakingIsFasterThanGainingSpeed) { expect_accepted_everywhere(2e-8, 3e-6); }

TEST(Tail, IsAcceptedWhereAccelerationIsAsSmallAsRounding) { expect_accepted_everywhere(1e-10, 7e-11); }

/// Down to zero speed, in two ticks at least: a jump to rest would add up with that of a corner just after.
TEST(Tail, EndsOnAWholeTickWithoutAJump) {
    const Subticks corner{12 * kSubticksPerTick + 40'000};
    const Profile hardly = plan_brake_to({}, 1e-7, 1e-6, corner);
    EXPECT_EQ(corner + hardly.duration(), subticks(Ticks{15}));
    EXPECT_NEAR(hardly.velocity_at(hardly.duration()), 0, 1e-9);
    const Profile more = plan_brake_to({}, 1e-3, 1e-6, corner);
    EXPECT_EQ(corner + more.duration(), subticks(Ticks{1013}));
    EXPECT_NEAR(more.velocity_at(more.duration()), 0, 1e-9);
    EXPECT_GE(more.phases[0].acceleration(), -1e-6);
}

}  // namespace
}  // namespace lockstep
