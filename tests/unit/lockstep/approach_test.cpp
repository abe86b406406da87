// A program continues from a line: first the tool leaves the work, then it crosses, then it goes down.
#include "clients/lockstep/job/approach.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/lockstep/job/approach_text.hpp"
#include "clients/lockstep/job/restart.hpp"
#include "services/documents/machine_file.hpp"
#include "services/documents/program_file.hpp"

namespace lockstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Approach : testing::Test {
    MachineSetup machine = load_machine_file("deploy/examples/three-axis.textproto").value();  // Z homes first, upward

    std::vector<ApproachMove> to_work(const std::vector<double>& at_mm, const std::string& lift = "") const {
        return approach(machine, lifts_of(machine, lift).value(), at_mm, {60, 40, 2}, 10);
    }
};

TEST_F(Approach, LiftsThenCrossesThenGoesDownWithTheProgramsFeed) {
    const auto moves = to_work({10, 20, 1});
    ASSERT_EQ(moves.size(), 3U);
    EXPECT_EQ(moves[0].what, "lifts");
    EXPECT_THAT(moves[0].move.target_mm, ElementsAre(10, 20, 58)) << "to Z's park position";
    EXPECT_TRUE(moves[0].move.rapid);
    EXPECT_THAT(moves[1].move.target_mm, ElementsAre(60, 40, 58));
    EXPECT_TRUE(moves[1].move.rapid);
    EXPECT_THAT(moves[2].move.target_mm, ElementsAre(60, 40, 2));
    EXPECT_FALSE(moves[2].move.rapid);
    EXPECT_DOUBLE_EQ(moves[2].move.feed_mm_s, 10);
    EXPECT_DOUBLE_EQ(moves[2].length_mm, 56);
}

TEST_F(Approach, DoesNotComeDownToCross) {
    const auto moves = to_work({10, 20, 59});
    ASSERT_EQ(moves.size(), 2U);
    EXPECT_THAT(moves[0].move.target_mm, ElementsAre(60, 40, 59));
}

TEST_F(Approach, LiftsToTheRequestedPlace) {
    EXPECT_THAT(to_work({10, 20, 1}, "Z=30").front().move.target_mm, ElementsAre(10, 20, 30));
    EXPECT_FALSE(lifts_of(machine, "Z=1000"));
    EXPECT_FALSE(lifts_of(machine, "Q=1"));
}

TEST_F(Approach, LiftsToTheSafeHeightOfTheConfiguration) {
    machine.axes[2].safe_height_mm = 25;
    EXPECT_THAT(to_work({10, 20, 1}).front().move.target_mm, ElementsAre(10, 20, 25));
    EXPECT_THAT(to_work({10, 20, 30}).front().move.target_mm, ElementsAre(60, 40, 30)) << "it does not go down";
    EXPECT_THAT(to_work({10, 20, 1}, "Z=30").front().move.target_mm, ElementsAre(10, 20, 30)) << "as asked";
}

TEST_F(Approach, IsKnownBySafeHeightIfAllAxesHomeTogether) {
    for (AxisConfig& axis : machine.axes) { axis.homing.sequence = 0; }
    machine.axes[2].safe_height_mm = 25;
    const auto lifts = lifts_of(machine, "");
    ASSERT_TRUE(lifts);
    ASSERT_EQ(lifts->size(), 1U);
    EXPECT_EQ(lifts->front().axis, 2U);
}

TEST_F(Approach, IsEmptyIfTheMachineIsThere) { EXPECT_THAT(to_work({60, 40, 2}), IsEmpty()); }

TEST_F(Approach, WithoutAFeedGoesDownAtTheStartVelocity) {
    const auto moves = approach(machine, lifts_of(machine, "").value(), {10, 20, 1}, {60, 40, 2}, 0);
    EXPECT_FALSE(moves.back().move.rapid);
    EXPECT_DOUBLE_EQ(moves.back().move.feed_mm_s, machine.axes[2].start_velocity_mm_s);
}

/// It is unknown which axis lifts the tool.
TEST_F(Approach, IsRefusedIfAllAxesHomeTogether) {
    for (AxisConfig& axis : machine.axes) { axis.homing.sequence = 0; }
    const auto lifts = lifts_of(machine, "");
    ASSERT_FALSE(lifts);
    EXPECT_THAT(lifts.error(), HasSubstr("--lift Z=40"));
}

struct Restart : Approach {
    static constexpr const char* kText = "G20 G91 F10\nG92 X1\nG1 X1\nG0 Y1\nG21 G90 F600\nG1 X50\nG1 Y9\n";
    GcodeSetup setup = gcode_setup(machine, {5, 5, 2}, "p.gcode");
    Program program = parse_gcode(kText, setup).value();

    Rest from(int line) const {
        return rest_of(program, kText, setup, {.from_line = line}, machine, {80, 80, 1}).value();
    }
};

TEST_F(Restart, BeginsAtTheEndOfTheLineBefore) {
    const Rest rest = from(6);
    ASSERT_EQ(rest.approach.size(), 3U);
    EXPECT_THAT(rest.program.start_mm, ElementsAre(80, 80, 1));
    EXPECT_THAT(rest.approach.back().move.target_mm, ElementsAre(5 + 25.4, 5 + 25.4, 2));
    EXPECT_EQ(rest.program.blocks.size(), 5U);
    EXPECT_EQ(rest.program.blocks.front().line, 6);
}

TEST_F(Restart, RestoresTheModalStateOfTheLinesBefore) {
    const ModalState early = from(3).modal;
    EXPECT_TRUE(early.inches);
    EXPECT_TRUE(early.relative);
    EXPECT_EQ(modal_text(machine, early), "  begins with G20 G91 F10.0, its 0 at X=-20.400");
    EXPECT_THAT(modal_text(machine, from(6).modal), HasSubstr("begins with G21 G90 F600.0"));
}

TEST_F(Restart, AfterTheEndIsRefused) {
    EXPECT_FALSE(rest_of(program, kText, setup, {.from_line = 40}, machine, {80, 80, 1}));
}

}  // namespace
}  // namespace lockstep
