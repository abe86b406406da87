#include "core/path/geometry/chord_joiner.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lockstep {
namespace {

PathSetup plane() {
    return {std::vector<AxisLimits>(2, {.min_steps = -100'000, .max_steps = 100'000}), {80, 80}, Ticks{1000}};
}

struct Chords {
    std::vector<std::pair<double, double>> to_mm;
    MoveSettings settings;
};

std::vector<Quadratic> pieces_of(const PathTrail& trail) {
    std::vector<Quadratic> pieces;
    for (std::size_t k = 0; k < trail.end(); ++k) { pieces.push_back(trail.piece(k)); }
    return pieces;
}

/// Joins the chords. Chord k has block k.
PathTrail trail_of(const Chords& chords) {
    ChordJoiner joiner(plane());
    joiner.begin(PlaceVector::zeros(2));
    PathTrail trail;
    std::uint32_t block = 0;
    for (const auto& [x, y] : chords.to_mm) { joiner.add({x * 80, y * 80}, chords.settings, ++block, trail); }
    joiner.finish(joiner.at(), trail);
    return trail;
}

std::vector<Quadratic> join(const Chords& chords) { return pieces_of(trail_of(chords)); }

double length_of(const std::vector<Quadratic>& pieces) {
    double mm = 0;
    for (const Quadratic& piece : pieces) { mm += piece.length; }
    return mm;
}

TEST(ChordJoiner, MakesALineOfItsParts) {
    Chords chords;
    for (int k = 1; k <= 150; ++k) { chords.to_mm.emplace_back(0.08 * k, 0.06 * k); }
    const std::vector<Quadratic> pieces = join(chords);
    EXPECT_LE(pieces.size(), 10U);
    for (const Quadratic& piece : pieces) { EXPECT_TRUE(piece.is_straight); }
    EXPECT_NEAR(length_of(pieces), 15, 1e-9);
}

TEST(ChordJoiner, KeepsCornersExactly) {
    Chords chords;
    for (int k = 1; k <= 50; ++k) { chords.to_mm.emplace_back(0.1 * k, 0); }
    for (int k = 1; k <= 50; ++k) { chords.to_mm.emplace_back(5, 0.1 * k); }
    bool has_corner = false;
    for (const Quadratic& piece : join(chords)) {
        has_corner = has_corner || (piece.from[0] == 5 * 80 && piece.from[1] == 0);
    }
    EXPECT_TRUE(has_corner);
}

TEST(ChordJoiner, MakesCurvesOfChordsWithinTheTolerance) {
    Chords chords;
    for (int k = 1; k <= 400; ++k) {
        chords.to_mm.emplace_back(20 * std::sin(0.005 * k), 20 - 20 * std::cos(0.005 * k));
    }
    const std::vector<Quadratic> pieces = join(chords);
    EXPECT_LE(pieces.size(), 20U);
    for (const Quadratic& piece : pieces) {
        for (const double share : {0.1, 0.5, 0.9}) {
            const double x = piece.place(0, share * piece.length) / 80;
            const double y = piece.place(1, share * piece.length) / 80;
            EXPECT_NEAR(std::hypot(x, y - 20), 20, 0.5 / 80);
        }
    }
}

TEST(ChordJoiner, JoinsNothingWhereThePathIsToBeExact) {
    Chords chords{.to_mm = {}, .settings = {.mode = PathMode::ExactPath}};
    for (int k = 1; k <= 20; ++k) { chords.to_mm.emplace_back(0.1 * k, 0.01 * (k % 2)); }
    const std::vector<Quadratic> pieces = join(chords);
    ASSERT_EQ(pieces.size(), 20U);
    for (std::size_t k = 1; k < pieces.size(); ++k) {
        EXPECT_DOUBLE_EQ(pieces[k].from[0], chords.to_mm[k - 1].first * 80);
        EXPECT_DOUBLE_EQ(pieces[k].from[1], chords.to_mm[k - 1].second * 80);
    }
}

TEST(ChordJoiner, JoinsMoreWithAWiderTolerance) {
    Chords chords;
    for (int k = 1; k <= 100; ++k) { chords.to_mm.emplace_back(5 * std::sin(0.1 * k), 5 - 5 * std::cos(0.1 * k)); }
    const std::size_t narrow = join(chords).size();
    chords.settings.tolerance_mm = 0.05;
    EXPECT_LT(join(chords).size(), narrow / 2);
}

/// The middle of a bend that is rounded with a wide tolerance would be 0.4 steps outside of the travel.
TEST(ChordJoiner, StaysWithinTheTravelHoweverWideTheTolerance) {
    PathSetup setup = plane();
    setup.limits[1].max_steps = 80;
    ChordJoiner joiner(setup);
    PathTrail trail;
    joiner.begin(PlaceVector::zeros(2));
    for (std::uint32_t k = 1; k <= 200; ++k) {
        const double x = 4.0 * k;
        PlaceVector at = PlaceVector::zeros(2);
        at[0] = x;
        at[1] = std::min(80.0, 160 * std::sin(x / 255));
        joiner.add(at, {.feed_mm_per_tick = 1e-4, .tolerance_mm = 0.5}, k, trail);
    }
    joiner.finish(joiner.at(), trail);
    for (const Quadratic& piece : pieces_of(trail)) {
        for (int k = 0; k <= 10; ++k) { EXPECT_LT(piece.place(1, piece.length * k / 10), 80.5); }
    }
}

TEST(ChordJoiner, EndsPiecesWhereTheFeedChanges) {
    ChordJoiner joiner(plane());
    joiner.begin(PlaceVector::zeros(2));
    PathTrail trail;
    for (std::uint32_t k = 1; k <= 40; ++k) {
        joiner.add({8.0 * k, 0}, {.feed_mm_per_tick = k <= 20 ? 1e-4 : 2e-4}, k, trail);
    }
    joiner.finish(joiner.at(), trail);
    double slow_mm = 0;
    for (const Quadratic& piece : pieces_of(trail)) { slow_mm += piece.feed_mm_per_tick < 1.5e-4 ? piece.length : 0; }
    EXPECT_NEAR(slow_mm, 2, 1e-9);
}

/// A chord that is too short counts as part of the next one.
TEST(ChordJoiner, MarksWhereEachChordBegins) {
    Chords chords;
    for (int k = 1; k <= 50; ++k) { chords.to_mm.emplace_back(0.1 * k, 0); }
    chords.to_mm[20] = {2.0 + 1e-7, 0};
    const PathTrail trail = trail_of(chords);
    for (std::uint32_t block = 1; block <= 50; ++block) {
        const auto spot = trail.spot_of({block, {}});
        ASSERT_TRUE(spot);
        const double at = trail.piece(spot->piece).place(0, spot->u) / 80;
        EXPECT_NEAR(at, 0.1 * (block == 21 ? 20 : block == 22 ? 20 : block - 1), 1e-6) << block;
    }
    EXPECT_EQ(trail.spot_of({21, {}}), trail.spot_of({22, {}}));
}

}  // namespace
}  // namespace lockstep
