// The gap between a probe's ball and the solids of a simulated workpiece.
#include "sim_fpga/contacts/workpiece.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim_fpga/plant.hpp"

namespace lockstep {
namespace {

constexpr double kTip_mm = 2;

WorkBlock block() {
    return {.x_min_mm = 10, .x_max_mm = 50, .y_min_mm = 20, .y_max_mm = 60, .top_mm = 5, .wave_length_mm = 100};
}

double gap(const WorkBlock& block, const WorkPlace& at, double length_mm = 0) {
    return Workpiece({.tip_mm = kTip_mm, .tip_length_mm = length_mm, .blocks = {block}, .posts = {}}).gap_mm(0, at);
}

TEST(SimulatedWorkpiece, TouchesTheTopWithTheLowestPointOfTheBall) {
    EXPECT_NEAR(gap(block(), {30, 40, 8}), 3, 1e-12);
    EXPECT_NEAR(gap(block(), {30, 40, 5}), 0, 1e-12);
    EXPECT_NEAR(gap(block(), {30, 40, 35}, 30), 0, 1e-12);
}

TEST(SimulatedWorkpiece, TouchesTheSidesWithTheRadiusOfTheBall) {
    EXPECT_NEAR(gap(block(), {9, 40, 0}), 0, 1e-12);
    EXPECT_NEAR(gap(block(), {54, 40, 0}), 3, 1e-12);
    EXPECT_NEAR(gap(block(), {30, 61, -100}), 0, 1e-12);
    EXPECT_NEAR(gap(block(), {7, 16, 0}), 4, 1e-12) << "the corner is 3 and 4 mm away, less the radius";
}

TEST(SimulatedWorkpiece, TheBallRollsOverAnEdge) {
    const double at_45_degrees = std::numbers::sqrt2 / 2;
    EXPECT_NEAR(gap(block(), {10 - at_45_degrees, 40, 5 - kTip_mm / 2 + at_45_degrees}), 0, 1e-12);
}

TEST(SimulatedWorkpiece, TouchesTheWallOfABoreFromWithinOnly) {
    WorkBlock bored = block();
    bored.bores = {{.x_mm = 30, .y_mm = 40, .diameter_mm = 20}};
    EXPECT_NEAR(gap(bored, {30, 40, 0}), 9, 1e-12);
    EXPECT_NEAR(gap(bored, {39, 40, 0}), 0, 1e-12);
    EXPECT_NEAR(gap(bored, {30, 31, -50}), 0, 1e-12);
    EXPECT_NEAR(gap(bored, {45, 40, 5}), 0, 1e-12) << "the top beside the bore";
}

TEST(SimulatedWorkpiece, ATiltedTopIsTouchedAtItsNormal) {
    WorkBlock tilted = block();
    tilted.rise_x = 0.75;
    const double height = 5 + 0.75 * 20;  // of the top at x = 30
    // The ball touches at its normal, (-0.6, 0, 0.8): its lowest point is then 0.25 radii above the top.
    EXPECT_NEAR(gap(tilted, {30, 40, height + 0.25 * kTip_mm / 2}), 0, 1e-12);
}

TEST(SimulatedWorkpiece, AWavedTopHasItsHeight) {
    WorkBlock waved = block();
    waved.wave_mm = 0.5;
    EXPECT_NEAR(Workpiece::top_mm(waved, 35, 45), 5.5, 1e-12);
    EXPECT_NEAR(Workpiece::top_mm(waved, 35, 20), 5, 1e-12);
    EXPECT_NEAR(gap(waved, {35, 45, 5.5}), 0, 1e-12) << "the summit is level";
}

TEST(SimulatedWorkpiece, ATurnedBlockTurnsAboutItsFirstCorner) {
    WorkBlock turned = block();
    turned.angle_deg = 90;
    turned.bores = {{.x_mm = 30, .y_mm = 40, .diameter_mm = 20}};
    EXPECT_NEAR(gap(turned, {11, 30, 0}), 0, 1e-9) << "its lower side is now the right one";
    EXPECT_NEAR(gap(turned, {-10, 40, 0}), 9, 1e-9) << "the centre of its bore";
}

TEST(SimulatedWorkpiece, APostClosesTheProbeOfItsNumberOnly) {
    const Workpiece work({.tip_mm = kTip_mm,
                          .blocks = {},
                          .posts = {{.x_mm = 5, .y_mm = 5, .diameter_mm = 6, .top_mm = 1, .probe = 1}}});
    EXPECT_NEAR(work.gap_mm(1, {5, 5, 4}), 3, 1e-12);
    EXPECT_NEAR(work.gap_mm(1, {10, 5, -4}), 1, 1e-12);
    EXPECT_TRUE(std::isinf(work.gap_mm(0, {5, 5, 1})));
}

/// A contact and a person's file may close one input; it is closed while either does.
TEST(SimulatedContact, ClosesAnInputBesideWhateverElseClosesIt) {
    for (const bool active_low : {false, true}) {
        Plant plant(MotorConfig{}, 1000);
        const InputConfig input{.name = "tip", .motor = "Z", .channel = 3, .active_low = active_low};
        const auto is_closed = [&] { return ((plant.pins() >> 3 & 1U) != 0) != active_low; };
        set_input(plant, input, false);
        EXPECT_FALSE(is_closed());
        set_contact(plant, input, true);
        EXPECT_TRUE(is_closed());
        set_input(plant, input, false);
        EXPECT_TRUE(is_closed());
        set_contact(plant, input, false);
        EXPECT_FALSE(is_closed());
    }
}

}  // namespace
}  // namespace lockstep
