// Why a job pauses, in words, and the way back to its place.
#include "core/pause.hpp"

#include <gtest/gtest.h>

#include "core/coordinator/path/return_way.hpp"

namespace lockstep {
namespace {

TEST(PauseText, SaysWhatThePersonHasToDo) {
    EXPECT_EQ(text_of(Pause{PauseReason::ToolChange, 2, "6 mm end mill"}), "change to tool 2: 6 mm end mill");
    EXPECT_EQ(text_of(Pause{PauseReason::ToolChange, 0, ""}), "take out the tool");
    EXPECT_EQ(text_of(Pause{PauseReason::ProgramStop, 0, "turn the part over"}), "program stop: turn the part over");
    EXPECT_EQ(text_of(Pause{PauseReason::OptionalStop, 0, ""}), "optional stop");
    EXPECT_EQ(text_of(Pause{PauseReason::PalletChange, 0, ""}), "change the pallet");
}

TEST(PauseText, CanBePrintedAndIsNotTooLong) {
    EXPECT_EQ(pause_text("  turn\tit \x1b[2J over\xff "), "turn it  [2J over");
    EXPECT_EQ(pause_text(" "), "");
    EXPECT_EQ(pause_text(std::string(500, 'x')).size(), kMaxPauseText);
    EXPECT_EQ(pause_text(pause_text(std::string(126, 'x') + " y")), std::string(126, 'x'));
}

MachineConfig machine_of(const std::vector<std::string>& axes) {
    MachineConfig machine;
    for (const std::string& name : axes) {
        AxisConfig axis;
        axis.name = name;
        axis.steps_per_mm = 100;
        machine.axes.push_back(axis);
    }
    return machine;
}

std::string way(const std::vector<std::string>& axes, std::vector<std::int64_t> here, std::vector<std::int64_t> place) {
    const Program program = return_way(machine_of(axes), here, place);
    for (const Block& block : program.blocks) {
        const auto& move = std::get<ProgramMove>(block.action);
        EXPECT_TRUE(move.rapid);
        EXPECT_EQ(move.mode, PathMode::ExactStop);
    }
    return text_of_way(program);
}

TEST(ReturnWay, LiftsCrossesAndGoesDown) {
    EXPECT_EQ(way({"X", "Y", "Z"}, {3000, 500, -900}, {1000, 700, -150}),
              "Z to -1.5 mm, then X to 10 mm and Y to 7 mm");
    EXPECT_EQ(way({"X", "Y", "Z"}, {3000, 500, 2000}, {1000, 700, -150}),
              "X to 10 mm and Y to 7 mm, then Z to -1.5 mm");
    EXPECT_EQ(way({"X", "Y", "Z"}, {3000, 500, 2000}, {3000, 500, -150}), "Z to -1.5 mm");
}

TEST(ReturnWay, WithoutZIsOneLine) {
    EXPECT_EQ(way({"X", "A"}, {3000, 500}, {1000, 9000}), "X to 10 mm and A to 90 deg");
}

TEST(ReturnWay, IsEmptyAtThePlace) { EXPECT_EQ(way({"X", "Z"}, {3000, 500}, {3000, 500}), ""); }

}  // namespace
}  // namespace lockstep
