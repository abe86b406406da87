// The errors in `board`, and what a board means when it is right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/hardware/device_abilities.hpp"
#include "core/kinematics/motors.hpp"
#include "services/documents/machine_file.hpp"
#include "services/documents/placement.hpp"
#include "tests/unit/documents/machine_text_examples.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

/// The shortest machine with these blocks behind its axis, each in a line, from line 11 on.
std::string with_blocks(std::initializer_list<std::string> blocks) {
    std::string text(kShortest);
    for (const std::string& block : blocks) { text += block + "\n"; }
    return text;
}

std::string error_with_board(const std::string& text) {
    const auto read = parse_machine(text);
    return read ? "no error" : to_text("m", read.error());
}

const std::string kIo = R"(board { name: "IO" })";
const std::string kAir = R"(output { name: "air" board: "IO" use: FLOOD })";

TEST(Boards, WrongValuesAreRefusedWithPlaceValueAndRemedy) {
    const std::pair<std::string, std::string> mistakes[] = {
        {with_blocks({"board { }", kAir}), "m:11:1: error: board[0].name is missing"},
        {with_blocks({R"(board { name: "4" })", R"(output { name: "air" board: "4" })"}),
         "m:11:9: error: the board's name is \"4\"; it must be a letter"},
        {with_blocks({R"(board { name: "x" })", R"(output { name: "air" board: "x" })"}),
         "m:11:9: error: x names an axis, a motor or another board already; give this board another name"},
        {with_blocks({kIo, R"(board { name: "io" })", kAir, R"(output { name: "a" board: "io" channel: 1 })"}),
         "m:12:9: error: io names an axis, a motor or another board already"},
        {with_blocks({R"(board { name: "IO" host: "a b" })", kAir}), "board[0].host is \"a b\"; it must be the name"},
        {with_blocks({R"(board { name: "IO" device: "usb:1" })", kAir}),
         "m:11:20: error: board[0].device is \"usb:1\"; it must be sim, shm:NAME, uio:PATH or board:NAME/N"},
        {with_blocks({kIo}),
         "m:11:9: error: board IO has no output and no input; write board: \"IO\" in the blocks of those that it has"},
        {with_blocks({kIo, R"(output { name: "air" motor: "IO" })"}), "board IO has no output and no input"},
        {with_blocks({kIo, kAir, R"(output { name: "a" motor: "IO" channel: 1 })"}),
         "m:13:20: error: output[1].motor is \"IO\"; it must be one of the machine's motors: X; IO is a board: write "
         "board: \"IO\""},
        {with_blocks({kIo, kAir, R"(output { name: "a" board: "X" channel: 1 })"}),
         "output[1].board is \"X\"; it must be one of the machine's boards: IO; motor X is no board: write motor: "
         "\"X\""},
        {with_blocks({R"(output { name: "a" board: "IO" })"}),
         "m:11:20: error: output[0].board is \"IO\"; it must be one of the machine's boards: it has none"},
        {with_blocks({kIo, R"(output { name: "a" board: "IO" motor: "X" })"}),
         "output[0].motor is \"X\" and output[0].board is \"IO\"; keep the one whose device has it"},
        {with_blocks({R"(output { name: "a" })"}),
         "output[0].motor and output[0].board are missing; name the motor whose device has it, or the board"},
        {with_blocks({kIo, kAir, R"(output { name: "a" board: "IO" })"}),
         "digital output 0 of board IO is given twice"},
        {with_blocks({kIo, kAir, R"(output { name: "a" board: "IO" channel: 16 })"}), "from 0 to 15"},
        {with_blocks({kIo, R"(input { name: "a" board: "IO" channel: 8 use: DOOR })"}),
         "input[0].channel is 8; it must be from 0 to 7: its device has 8 at most"},
        {with_blocks({kIo, R"(input { name: "io" board: "IO" channel: 3 use: DOOR })"}),
         "io names an axis, a motor, a board or another input already"},
        {with_blocks({kIo, R"(input { name: "a" board: "IO" channel: 3 use: DOOR })",
                      R"(input { name: "b" board: "IO" channel: 3 use: DOOR })"}),
         "input[1].channel is 3, which input a of board IO has already"},
        {with_blocks({kIo, kAir, R"(kinematics { matrix { row { motor: "IO" of { axis: "X" factor: 1 } } } })"}),
         "kinematics.matrix.row[0].motor is \"IO\"; it must be one of the machine's motors: X"},
        {with_blocks({R"(board { name: "IO" device: "uio:/dev/uio0" })", kAir, "timing { time_source: PTP }"}),
         "device uio:/dev/uio0 of board IO has a clock of its own, for whose error timing.time_source: PTP leaves no "
         "room; set NETWORK"}};
    for (const auto& [text, message] : mistakes) {
        const std::string found = error_with_board(text);
        EXPECT_THAT(found, HasSubstr(message));
        EXPECT_THAT(found, testing::MatchesRegex("m:[0-9]+:[0-9]+: [^\n]*\n?")) << "one error, with its place";
    }
}

TEST(Boards, ThatAreWrittenAreReadAgain) {
    const auto read = parse_machine(with_blocks({R"(board { name: "IO" host: "shed" device: "shm:io" })", kAir,
                                                 R"(input { name: "door" board: "IO" channel: 3 use: DOOR })",
                                                 "coordinator_host: "
                                                 "\"shed\""}));
    ASSERT_TRUE(read) << to_text("m", read.error());
    const auto again = parse_machine(machine_text(*read));
    ASSERT_TRUE(again) << to_text("m", again.error());
    EXPECT_EQ(again->boards, read->boards);
    EXPECT_EQ(again->outputs, read->outputs);
    EXPECT_EQ(again->inputs, read->inputs);
    EXPECT_EQ(config_hash(*again), config_hash(*read));
}

TEST(Boards, HaveNoSwitchesSoThatInputs0To2AreAsTheOthers) {
    const auto read = parse_machine(with_blocks({kIo, R"(input { name: "a" board: "IO" channel: 0 use: DOOR })",
                                                 R"(input { name: "b" board: "IO" channel: 2 use: EMERGENCY_STOP })"}));
    ASSERT_TRUE(read) << to_text("m", read.error());
    const auto motors = motors_of(*read);
    const DeviceSetup setup = setup_of(*read, motors.back());
    EXPECT_EQ(setup.limit_min | setup.limit_max | setup.home, 0U);
    EXPECT_EQ(setup.stop, 1U << 2);
    EXPECT_EQ(setup_of(*read, motors.front()).home, 1U << 2);
}

TEST(Boards, AreAPartOfTheConfigurationsHash) {
    const auto one = parse_machine(with_blocks({kIo, kAir})).value();
    MachineSetup other = one;
    other.boards[0].host = "shed";
    EXPECT_NE(config_hash(one), config_hash(other));
}

TEST(Boards, WhoseDeviceLacksAChannelAreRefusedBeforeAnythingMoves) {
    const auto read = parse_machine(with_blocks({kIo, R"(output { name: "a" board: "IO" channel: 9 })"})).value();
    const MotorConfig board = motors_of(read)[1];
    EXPECT_EQ(lack_of({}, read, board).value_or(""), "device: there is no digital output 9; it has 8, numbered from 0");
}

TEST(Boards, RunOnTheirHostLikeMotors) {
    const auto machine = parse_machine(with_blocks({kIo, kAir})).value();
    EXPECT_EQ(axis_to_run(machine, "IO", "here").value(), 1U);
    EXPECT_EQ(placed_on(machine, "here").axes, (std::vector<MotorIndex>{MotorIndex{0}, MotorIndex{1}}));
    EXPECT_EQ(machine.network.processes, 3U);
}

}  // namespace
}  // namespace lockstep
