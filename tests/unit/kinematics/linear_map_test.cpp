#include "core/kinematics/linear_map.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace lockstep {
namespace {

LinearMap map_of(const std::vector<std::vector<double>>& rows) {
    LinearMap map(rows.size(), rows[0].size());
    for (std::size_t m = 0; m < rows.size(); ++m) {
        for (std::size_t i = 0; i < rows[m].size(); ++i) { map.factor(m, i) = rows[m][i]; }
    }
    return map;
}

std::vector<double> places(const LinearMap& map, const std::vector<double>& at) {
    std::vector<double> out;
    for (std::size_t m = 0; m < map.motors(); ++m) { out.push_back(map.place(m, at)); }
    return out;
}

TEST(LinearMap, AddsTheSharesOfTheAxes) {
    EXPECT_EQ(places(map_of({{1, 1}, {1, -1}}), {3, 5}), (std::vector<double>{8, -2}));
}

TEST(LinearMap, GoesBackFromMotorsToAxes) {
    const LinearMap map = map_of({{1, 2, 0.5}, {0, 0, -3}, {0.25, 1, 7}});
    const std::vector<double> at{1.5, -20, 3};
    const std::vector<double> back = places(*map.inverse(), places(map, at));
    for (std::size_t i = 0; i < at.size(); ++i) { EXPECT_NEAR(back[i], at[i], 1e-12); }
}

/// Two motors of one axis that disagree: the axis is between them.
TEST(LinearMap, GoesBackToThePlaceThatIsNearestToAllMotors) {
    EXPECT_EQ(places(*map_of({{1}, {1}}).inverse(), {10, 11}), (std::vector<double>{10.5}));
}

TEST(LinearMap, HasNoInverseIfTwoPlacesHaveTheSameMotors) {
    EXPECT_FALSE(map_of({{1, 1}, {2, 2}}).inverse());
    EXPECT_FALSE(map_of({{1, 1}}).inverse());
    EXPECT_FALSE(map_of({{1, 0}, {1, 0}}).inverse());
}

TEST(LinearMap, AppliesOneMapAfterAnother) {
    const LinearMap belts = map_of({{1, 1}, {1, -1}});
    const LinearMap shear = map_of({{1, 0.5}, {0, 1}});
    EXPECT_EQ(places(belts.after(shear), {2, 4}), places(belts, places(shear, {2, 4})));
}

TEST(LinearMap, KnowsWhichAxisAloneMovesAMotor) {
    const LinearMap map = map_of({{0, 2}, {1, 1}, {0, 0}});
    EXPECT_EQ(map.only_axis_of(0), 1U);
    EXPECT_EQ(map.only_axis_of(1), std::nullopt);
    EXPECT_EQ(map.only_axis_of(2), std::nullopt);
    EXPECT_TRUE(LinearMap::identity(3).is_identity());
    EXPECT_FALSE(map.is_identity());
}

}  // namespace
}  // namespace lockstep
