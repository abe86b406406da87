// A feed waits until the spindle has its speed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/gcode/session/gcode_session.hpp"
#include "tests/unit/gcode/three_axes.hpp"

namespace lockstep {
namespace {

/// One letter for each block: e an event, r a rapid move, f a feed, w a wait for an input, d a dwell.
std::string blocks_of(const char* text, const GcodeSpinUp& spin_up) {
    GcodeSetup setup = three_axes();
    setup.spin_up = spin_up;
    setup.unassigned.spindle = WordRule::Ignore;
    const auto read = read_gcode(text, setup);
    EXPECT_TRUE(read) << read.error().front().message;
    std::string letters;
    for (const Block& block : read ? read->program.blocks : std::vector<Block>{}) {
        const auto* move = std::get_if<ProgramMove>(&block.action);
        letters += move != nullptr                                      ? (move->rapid ? 'r' : 'f')
                   : std::holds_alternative<ProgramEvent>(block.action) ? 'e'
                   : std::holds_alternative<Dwell>(block.action)        ? 'd'
                                                                        : 'w';
    }
    return letters;
}

TEST(SpinUp, ComesBeforeTheFirstFeedAfterAChange) {
    const GcodeSpinUp ready{.input = 5, .seconds = 10};
    EXPECT_EQ(blocks_of("M3 S100\nG0 X1\nG1 X2 F600\nX3\n", ready), "erwff");
    EXPECT_EQ(blocks_of("M3 S100\nG1 X2 F600\nS200\nX3\nX4\n", ready), "ewfewff");
    EXPECT_EQ(blocks_of("M3 S100\nG2 X2 I1 F600\n", ready), "ewf");
}

TEST(SpinUp, IsNotAwaitedWhileTheSpindleStands) {
    EXPECT_EQ(blocks_of("G1 X2 F600\n", {.input = 5, .seconds = 10}), "f");
    EXPECT_EQ(blocks_of("M3 S100\nM5\nG1 X2 F600\n", {.input = 5, .seconds = 10}), "eef");
}

TEST(SpinUp, IsARestWhereNoInputTellsIt) {
    EXPECT_EQ(blocks_of("M3 S100\nG1 X2 F600\n", {.input = {}, .seconds = 2.5}), "edf");
}

TEST(SpinUp, IsAwaitedAcrossTheLinesOfASender) {
    GcodeSetup setup = three_axes();
    setup.spin_up = GcodeSpinUp{.input = 5, .seconds = 10};
    setup.unassigned.spindle = WordRule::Ignore;
    MachineConfig machine;
    for (const GcodeAxis& axis : setup.axes) { machine.axes.push_back({.name = axis.name, .steps_per_mm = 80}); }
    GcodeSession session(setup, machine, 0);
    const auto blocks = [&](const char* line) {
        auto read = session.read(line, {.place_mm = {0, 0, 0}, .values = {}});
        EXPECT_TRUE(read) << read.error().message;
        const std::size_t count = read->blocks.size();
        session.commit(*read);
        return count;
    };
    EXPECT_EQ(blocks("M3 S100"), 1U);
    EXPECT_EQ(blocks("G0 X1"), 1U);
    EXPECT_EQ(blocks("G1 X2 F600"), 2U) << "a wait and a move";
    EXPECT_EQ(blocks("X3"), 1U);
}

}  // namespace
}  // namespace lockstep
