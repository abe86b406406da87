// The errors in `board` with a link and in the devices behind it, and what such a board means when it is right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/kinematics/motors.hpp"
#include "services/documents/machine_file.hpp"
#include "tests/unit/documents/machine_text_examples.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

const std::string kDevice = R"(device: "board:pico1/0")";
const std::string kPico = R"(board { name: "pico1" link: "serial:/dev/ttyUSB0" })";

/// The shortest machine with this device in line 10 and these blocks from line 12 on.
std::string with_board(const std::string& device, std::initializer_list<std::string> blocks) {
    std::string text = axis_with(device);
    for (const std::string& block : blocks) { text += block + "\n"; }
    return text;
}

TEST(BoardLinks, WrongValuesAreRefusedWithPlaceValueAndRemedy) {
    const std::string second = R"(axis { name: "Y" steps_per_mm: 80 start_velocity_mm_s: 10 max_velocity_mm_s: 150
  max_accel_mm_s2: 1500 position_min_mm: 0 position_max_mm: 200 host: "shed" device: "board:pico1/)";
    const std::pair<std::string, std::string> mistakes[] = {
        {with_board(kDevice, {}),
         "m:10:3: error: device board:pico1/0 of motor X is at a board that the machine does not have; add board { "
         "name: \"pico1\" link: \"serial:/dev/...\" }"},
        {with_board(R"(device: "board:pico1/16")", {kPico}), "m:10:3: error: device is \"board:pico1/16\"; it must be"},
        {with_board(kDevice, {R"(board { name: "pico1" link: "ttyUSB0" })"}),
         "m:12:23: error: the link of board pico1 is \"ttyUSB0\"; it must be serial:PATH or tcp:ADDRESS:PORT"},
        {with_board(kDevice, {R"(board { name: "pico1" link: "tcp:1.2.3.4:1" host: "shed" })"}),
         "board[0] has a link, so board[0].host and board[0].device have no meaning; remove them"},
        {with_board(kDevice, {kPico, R"(board { name: "Pico1" link: "tcp:1.2.3.4:1" })"}),
         "m:13:9: error: Pico1 names an axis, a motor or another board already"},
        {with_board("", {kPico}),
         "m:12:9: error: no motor has a device of board pico1; write device: \"board:pico1/0\""},
        {with_board(kDevice, {kPico, second + R"(0" })"}), "device board:pico1/0 is that of motor X already"},
        {with_board(kDevice, {kPico, second + R"(1" })"}),
         "motors X and Y have devices of board pico1, but run on host \"\" and on host \"shed\""},
        {with_board(kDevice, {kPico, "timing { time_source: PTP }"}), "leaves no room for the clock error of device"}};
    for (const auto& [text, message] : mistakes) {
        const auto read = parse_machine(text);
        const std::string found = read ? "no error" : to_text("m", read.error());
        EXPECT_THAT(found, HasSubstr(message));
        EXPECT_THAT(found, testing::MatchesRegex("m:[0-9]+:[0-9]+: [^\n]*\n?")) << "one error, with its place";
    }
}

TEST(BoardLinks, AreReadAgainAsTheyWereWrittenAndArePartOfTheHash) {
    const auto read = parse_machine(with_board(kDevice, {kPico}));
    ASSERT_TRUE(read) << to_text("m", read.error());
    EXPECT_TRUE(read->boards.empty()) << "it takes part in nothing";
    EXPECT_EQ(motor_count(*read), 1U);
    EXPECT_TRUE(read->estimates_clocks());
    const auto again = parse_machine(machine_text(*read));
    ASSERT_TRUE(again) << to_text("m", again.error());
    EXPECT_EQ(again->board_links, read->board_links);
    MachineSetup other = *read;
    other.board_links[0].link.place = "/dev/ttyUSB1";
    EXPECT_NE(config_hash(*read), config_hash(other));
}

}  // namespace
}  // namespace lockstep
