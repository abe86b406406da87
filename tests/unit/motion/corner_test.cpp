// Corners between ticks: the executed motion matches the plan, and fits a frame.
#include <gtest/gtest.h>

#include <cmath>

#include "core/motion/interpolate.hpp"
#include "core/motion/lookahead.hpp"
#include "core/protocol/messages.hpp"
#include "tests/unit/motion/scale.hpp"

namespace lockstep {
namespace {

constexpr double kStart = 1e-3;  // steps per tick
const std::vector<AxisLimits> kSlowLimits(2, {kStart, 0.05, 1e-8, 1e-8, -1'000'000, 1'000'000});

/// Straight moves through the places, all rapid.
std::vector<PathMove> moves_through(const std::vector<AxisCounts>& places) {
    std::vector<PathMove> moves;
    for (std::size_t i = 1; i < places.size(); ++i) {
        moves.push_back(make_move(places[i - 1], places[i], kSlowLimits, kScale, 0));
        moves.back().block = static_cast<std::uint32_t>(i);
    }
    return moves;
}

/// What axis 0 executes in the ticks [begin, end) of a path.
std::vector<Piece> pieces_in(const Path& path, Ticks begin, Ticks end, std::vector<Position>& at) {
    std::vector<Piece> first_axis;
    std::vector<Piece> pieces(at.size());
    PieceSource source(path, begin, end, at);
    while (source.next(pieces)) { first_axis.push_back(pieces[0]); }
    return first_axis;
}

double speed_before(const Piece& p) { return p.velocity.steps_per_tick() + p.acceleration.steps_per_tick2() / 2; }
double speed_after(const Piece& p) {
    return speed_before(p) + p.acceleration.steps_per_tick2() * static_cast<double>(p.ticks.value);
}

TEST(Corner, BetweenTicksLeavesNoTraceInTheSpeedBehindIt) {
    constexpr double kFewTicks = 4e-8;  // the effect of acceleration in these ticks, in steps per tick
    for (std::int64_t length = 100; length < 200; ++length) {
        const Path path =
            plan_path(moves_through({{0, 0}, {length, 37}, {0, 0}}), {}, kSlowLimits, {.least_move = Ticks{100}});
        const PathMove& back = path.moves[1];
        std::vector<Position> at{Position::steps(0), Position::steps(0)};
        const Ticks end = back.start.ceil() + Ticks{3};
        const std::vector<Piece> pieces = pieces_in(path, Ticks{0}, end, at);
        EXPECT_NEAR(speed_after(pieces.back()), -back.profile.velocity_at(subticks(end) - back.start), kFewTicks)
            << "length " << length;
    }
}

TEST(Corner, SoDoesTheEndOfAPathInTheSpeedBeforeIt) {
    constexpr double kFewTicks = 4e-8;
    for (std::int64_t length = 100; length < 200; ++length) {
        const Path path =
            plan_path(moves_through({{0, 0}, {length, 37}, {0, 0}}), {}, kSlowLimits, {.least_move = Ticks{100}});
        const PathMove& back = path.moves[1];
        std::vector<Position> at{Position::steps(0), Position::steps(0)};
        const Ticks end = path.duration().ceil();
        const Ticks last_frame = end - Ticks{3};
        (void)pieces_in(path, Ticks{0}, last_frame, at);
        const std::vector<Piece> pieces = pieces_in(path, last_frame, end, at);
        EXPECT_NEAR(speed_before(pieces[0]), -back.profile.velocity_at(subticks(last_frame) - back.start), kFewTicks)
            << "length " << length;
    }
}

TEST(Corner, AsManyAsAFrameCanHoldFitIt) {
    const MachineConfig machine{.name = "one", .axes = {}};
    std::vector<AxisCounts> places{{0, 0}};
    for (std::int64_t n = 1; n <= 500; ++n) { places.push_back({n % 3, n}); }
    const Path path = plan_path(moves_through(places), {}, kSlowLimits, bounds_of(machine));
    std::vector<Position> at{start_of(path, 0, 0), start_of(path, 1, 0)};
    const Ticks frame = machine.frame_ticks();
    for (Ticks begin{0}; begin < path.duration().ceil(); begin += frame) {
        const Ticks end = std::min(begin + frame, path.duration().ceil());
        EXPECT_LE(pieces_in(path, begin, end, at).size(), kMaxBodyPieces);
        EXPECT_LE(brake_from(path, subticks(end), kSlowLimits).moves.size() * 2, kMaxTailPieces);
    }
    EXPECT_EQ(at[1].count(), 500);
}

}  // namespace
}  // namespace lockstep
