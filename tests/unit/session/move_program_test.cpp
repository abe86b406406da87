#include "clients/session/move_program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/session/two_axes.hpp"

namespace lockstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<double> kStart{12.5, 3};

ProgramMove move_of(const MoveOptions& options) {
    const auto program = move_program(two_axes(), kStart, options);
    EXPECT_TRUE(program) << program.error();
    return program ? std::get<ProgramMove>(program->blocks.at(0).action) : ProgramMove{};
}

std::string error_of(const MoveOptions& options) {
    const auto program = move_program(two_axes(), kStart, options);
    EXPECT_FALSE(program);
    return program ? "" : program.error();
}

TEST(Target, IsAnAxisAndAPlaceInMillimetres) {
    EXPECT_EQ(parse_target("X=10")->axis, "X");
    EXPECT_EQ(parse_target("X=10")->mm, 10);
    EXPECT_EQ(parse_target("Y=-3.5")->mm, -3.5);
    EXPECT_EQ(parse_target("Turret_2=+0.25")->axis, "Turret_2");
}

TEST(Target, ThatIsInvalidIsRefusedWithAnExample) {
    for (const char* word :
         {"", "X", "X=", "=10", "X=ten", "X=10mm", "X=1e999", "X=nan", "X=inf", "X = 10", "X=0x10", "X=1,5"}) {
        const auto target = parse_target(word);
        ASSERT_FALSE(target) << word;
        EXPECT_THAT(target.error(), HasSubstr("X=10"));
    }
}

TEST(Move, GoesToAbsolutePlacesAndDoesNotMoveOtherAxes) {
    EXPECT_THAT(move_of({.targets = {"X=10"}}).target_mm, ElementsAre(10, 3));
    EXPECT_THAT(move_of({.targets = {"Y=-3.5", "x=0"}}).target_mm, ElementsAre(0, -3.5));
}

TEST(Move, StartsAtTheAxesPositionsIfRelative) {
    EXPECT_THAT(move_of({.targets = {"X=10", "Y=-1"}, .relative = true}).target_mm, ElementsAre(22.5, 2));
}

TEST(Move, IsRapidUnlessItHasAFeedPerMinute) {
    EXPECT_TRUE(move_of({.targets = {"X=10"}}).rapid);
    EXPECT_FALSE(move_of({.targets = {"X=10"}, .feed_mm_min = 600}).rapid);
    EXPECT_EQ(move_of({.targets = {"X=10"}, .feed_mm_min = 600}).feed_mm_s, 10);
}

TEST(Move, OfAxesOnTheirOwnMayTakeAGivenTime) {
    EXPECT_THAT(move_of({.targets = {"X=10"}, .own = true}).target_mm, ElementsAre(10, 3));
    EXPECT_FALSE(ticks_of(two_axes(), {.own = true}));
    EXPECT_EQ(ticks_of(two_axes(), {.own = true, .in_s = 0.5}), Ticks{500'000});
    EXPECT_THAT(error_of({.targets = {"X=10"}, .in_s = 0.5}), HasSubstr("add --own"));
    EXPECT_THAT(error_of({.targets = {"X=10"}, .feed_mm_min = 600, .own = true}),
                HasSubstr("with --own there is no common line"));
    EXPECT_THAT(error_of({.targets = {"X=10"}, .own = true, .in_s = 0}), HasSubstr("--in 0.000000 is out of range"));
    EXPECT_THAT(error_of({.targets = {"X=10"}, .own = true, .in_s = 601}), HasSubstr("to 600 s"));
}

TEST(Move, IsRefusedWithTheValueAndTheLimit) {
    EXPECT_THAT(error_of({.targets = {"X=200.5"}}), HasSubstr("outside the travel of axis X, 0.000 to 200.000 mm"));
    EXPECT_THAT(error_of({.targets = {"Y=-60"}, .relative = true}), HasSubstr("Y=-57.0000"));
    EXPECT_THAT(error_of({.targets = {"Q=5"}}), HasSubstr("it has: X Y"));
    EXPECT_THAT(error_of({.targets = {"X=5", "x=6"}}), HasSubstr("named twice"));
    EXPECT_THAT(error_of({.targets = {"X=5"}, .feed_mm_min = 0}), HasSubstr("--feed"));
    EXPECT_THAT(error_of({.targets = {"X=5"}, .feed_mm_min = -600}), HasSubstr("--feed"));
}

MachineSetup two_axes_with_probe() {
    MachineSetup machine = two_axes();
    machine.inputs = {{.name = "plate", .motor = "X", .use = InputUse::Probe, .number = 3}};
    return machine;
}

TEST(ProbeProgram, EndsWithAMoveThatTouches) {
    const auto program =
        probe_program(two_axes_with_probe(), {5, 5}, {.move = {.targets = {"X=20"}, .feed_mm_min = 60}, .away = true});
    ASSERT_TRUE(program) << program.error();
    ASSERT_EQ(program->blocks.size(), 2u);
    EXPECT_EQ(std::get<Probe>(program->blocks[0].action), (Probe{.input = 3, .opens = true, .must_touch = true}));
    EXPECT_EQ(std::get<ProgramMove>(program->blocks[1].action).feed_mm_s, 1);
}

TEST(ProbeProgram, NeedsAFeedAProbeAndAPlaceFurtherOn) {
    const MachineSetup machine = two_axes_with_probe();
    EXPECT_EQ(probe_program(machine, {5, 5}, {.move = {.targets = {"X=20"}}}).error(),
              "a probing move needs a feed; write --feed, in mm/min");
    EXPECT_EQ(probe_program(machine, {5, 5}, {.move = {.targets = {"X=5"}, .feed_mm_min = 60}}).error(),
              "the axes stand at the end of this move already; write a place further on");
    EXPECT_EQ(probe_program(machine, {5, 5}, {.move = {.targets = {"X=9"}, .feed_mm_min = 60}, .probe = 1}).error(),
              "the machine has no probe 1; it has: 3 (plate)");
    EXPECT_EQ(probe_program(two_axes(), {5, 5}, {.move = {.targets = {"X=9"}, .feed_mm_min = 60}}).error(),
              "the machine has no probe; write input { use: PROBE } in its file");
}

}  // namespace
}  // namespace lockstep
