#include "core/kinematics/delta_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lockstep {
namespace {

constexpr DeltaMap::Point kLow{-80, -70, 5};
constexpr DeltaMap::Point kHigh{90, 60, 200};

/// Three towers in an irregular triangle, with rods of different lengths.
DeltaMap delta() { return DeltaMap({{{-125, -60, 300}, {110, -75, 310}, {5, 130, 290}}}); }

DeltaMap::Point draw(std::mt19937_64& random) {
    const auto between = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
    return {between(kLow.x, kHigh.x), between(kLow.y, kHigh.y), between(kLow.z, kHigh.z)};
}

std::array<double, 3> heights(const DeltaMap& map, const DeltaMap::Point& at) {
    return {map.height_mm(0, at), map.height_mm(1, at), map.height_mm(2, at)};
}

TEST(DeltaMap, PutsTheCarriageARodAboveTheTool) {
    const DeltaMap map({{{-3, 0, 5}, {3, 0, 5}, {0, 12, 13}}});
    EXPECT_EQ(map.height_mm(0, {0, 0, 7}), 11);
    EXPECT_EQ(map.height_mm(2, {0, 0, 7}), 12);
}

TEST(DeltaMap, GoesBackFromCarriagesToTheTool) {
    const DeltaMap map = delta();
    std::mt19937_64 random(1);
    for (int k = 0; k < 1000; ++k) {
        const DeltaMap::Point at = draw(random);
        const DeltaMap::Point back = map.place(heights(map, at));
        ASSERT_NEAR(back.x, at.x, 1e-9);
        ASSERT_NEAR(back.y, at.y, 1e-9);
        ASSERT_NEAR(back.z, at.z, 1e-9);
    }
}

TEST(DeltaMap, RisesAsItsHeightsDo) {
    const DeltaMap map = delta();
    std::mt19937_64 random(2);
    constexpr double kStep = 1e-4;
    for (int k = 0; k < 1000; ++k) {
        const DeltaMap::Point at = draw(random);
        const DeltaMap::Point way{std::cos(k), std::sin(k), std::cos(3 * k)};
        const auto ahead = [&](double mm) {
            return DeltaMap::Point{at.x + mm * way.x, at.y + mm * way.y, at.z + mm * way.z};
        };
        for (std::size_t tower = 0; tower < DeltaMap::kTowers; ++tower) {
            const double change = map.height_mm(tower, ahead(kStep)) - map.height_mm(tower, ahead(-kStep));
            ASSERT_NEAR(map.rise_mm(tower, at, way), change / (2 * kStep), 1e-7);
        }
    }
}

/// The bounds are true everywhere, and reached at a corner or beside the tower.
TEST(DeltaMap, KnowsWhatATravelDemands) {
    const DeltaMap map = delta();
    std::mt19937_64 random(3);
    for (std::size_t tower = 0; tower < DeltaMap::kTowers; ++tower) {
        const DeltaMap::Reach reach = map.reach(tower, kLow, kHigh);
        double steepest = 0;
        double lowest = 1e9;
        const auto look = [&](const DeltaMap::Point& at) {
            ASSERT_LE(std::abs(map.rise_mm(tower, at, {1, 0, 0})), reach.steepest.x + 1e-12);
            ASSERT_LE(std::abs(map.rise_mm(tower, at, {0, 1, 0})), reach.steepest.y + 1e-12);
            ASSERT_GE(map.height_mm(tower, at), reach.lowest_mm - 1e-9);
            ASSERT_LE(map.height_mm(tower, at), reach.highest_mm + 1e-9);
            steepest = std::max(steepest, std::abs(map.rise_mm(tower, at, {1, 0, 0})));
            lowest = std::min(lowest, map.height_mm(tower, at));
        };
        for (int k = 0; k < 1000; ++k) { look(draw(random)); }
        for (const double x : {kLow.x, kHigh.x}) {
            for (const double y : {kLow.y, kHigh.y}) { look({x, y, kLow.z}); }
        }
        EXPECT_NEAR(steepest, reach.steepest.x, 1e-12);
        EXPECT_NEAR(lowest, reach.lowest_mm, 1e-9);
        EXPECT_NEAR(reach.least_root_mm, reach.lowest_mm - kLow.z, 1e-9);
    }
}

/// Counts of motors that are not homed may be any: no place of the tool belongs to them.
TEST(DeltaMap, GivesAFinitePlaceWhereTheRodsCannotMeet) {
    const DeltaMap map = delta();
    const DeltaMap::Point at = map.place({0, 5000, -3000});
    EXPECT_TRUE(std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z));
    EXPECT_GT(std::abs(map.height_mm(1, at) - 5000) + std::abs(map.height_mm(0, at)), 1);
    EXPECT_TRUE(std::isfinite(map.height_mm(0, {1e6, 0, 0})));
}

}  // namespace
}  // namespace lockstep
