#include "core/path/geometry/path_trail.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

Displacement mm(double way) { return {static_cast<Int128>(way * 0x1p64)}; }

Quadratic piece_of(double length) { return {.from = {0}, .slope = {80}, .bend = {0}, .length = length}; }

/// Block 1 is an arc of two pieces of 3 mm. Blocks 2, 3 and 5 are chords of 1 mm that one piece joins. Block 4 has no
/// length.
PathTrail example() {
    PathTrail trail;
    trail.mark(0, 1, 0);
    trail.add(piece_of(3));
    trail.mark(0, 1, 3);
    trail.add(piece_of(3));
    trail.mark(0, 2, 0);
    trail.mark(1, 3, 0);
    trail.mark(2, 5, 0);
    trail.add(piece_of(3));
    return trail;
}

TEST(PathTrail, NamesTheMoveAndTheWayAlongIt) {
    const PathTrail trail = example();
    EXPECT_EQ(trail.place_of({0, 0.5}), (PathPlace{1, mm(0.5)}));
    EXPECT_EQ(trail.place_of({1, 0.5}), (PathPlace{1, mm(3.5)}));
    EXPECT_EQ(trail.place_of({2, 1.25}), (PathPlace{3, mm(0.25)}));
    EXPECT_EQ(trail.place_of({2, 3}), (PathPlace{5, mm(1)}));
}

TEST(PathTrail, FindsTheSpotOfAPlace) {
    const PathTrail trail = example();
    EXPECT_EQ(trail.spot_of({1, mm(0.5)}), (PathSpot{0, 0.5}));
    EXPECT_EQ(trail.spot_of({1, mm(3.5)}), (PathSpot{1, 0.5}));
    EXPECT_EQ(trail.spot_of({3, mm(0.25)}), (PathSpot{2, 1.25}));
    EXPECT_EQ(trail.spot_of({5, mm(1)}), (PathSpot{2, 3}));
}

TEST(PathTrail, TakesTheNextMoveForOneWithoutALength) {
    EXPECT_EQ(example().spot_of({4, {}}), (PathSpot{2, 2}));
    EXPECT_EQ(example().spot_of({0, {}}), (PathSpot{0, 0}));
}

TEST(PathTrail, HasNoSpotOfAMoveThatHasNotBeenAdded) { EXPECT_FALSE(example().spot_of({6, {}})); }

TEST(PathTrail, StaysWithinTheMove) {
    EXPECT_EQ(example().spot_of({2, mm(1.5)}), (PathSpot{2, 1}));
    EXPECT_EQ(example().spot_of({5, mm(1.5)}), (PathSpot{2, 3}));
}

TEST(PathTrail, KeepsNumbersWhenItForgets) {
    PathTrail trail = example();
    trail.drop_before(2);
    EXPECT_EQ(trail.first(), 2U);
    EXPECT_EQ(trail.spot_of({3, mm(0.25)}), (PathSpot{2, 1.25}));
    EXPECT_EQ(trail.place_of({2, 1.25}), (PathPlace{3, mm(0.25)}));
}

TEST(PathTrail, TakesAPieceAwayWithItsMoves) {
    PathTrail trail = example();
    trail.pop_back();
    EXPECT_EQ(trail.end(), 2U);
    EXPECT_FALSE(trail.spot_of({3, {}}));
}

}  // namespace
}  // namespace lockstep
