// The errors in `board` with a link and in the devices behind it, and what such a board means when it is right.
#include <fmt/format.h>
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
         "m:12:23: error: the link of board pico1 is \"ttyUSB0\"; it must be serial:PATH, spi:PATH, spi:PATH@HZ or "
         "tcp:ADDRESS:PORT"},
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

TEST(BoardLinks, AnSpiCarriesTheWordsOfItsMotors) {
    const auto with_link = [](const std::string& link) {
        return parse_machine(with_board(kDevice, {R"(board { name: "pico1" link: ")" + link + "\" }"}));
    };
    const auto read = with_link("spi:/dev/spidev0.0");
    ASSERT_TRUE(read) << to_text("m", read.error());
    EXPECT_EQ(read->board_links[0].link.speed_hz, LinkName::kSpiSpeed_hz);
    const auto slow = with_link("spi:/dev/spidev0.0@1000000");
    ASSERT_FALSE(slow);
    // 80 bits for each of 12,000 steps/s, and looks, orders and pieces.
    EXPECT_EQ(
        to_text("m", slow.error()),
        "m:12:23: error: the motors of board pico1 need 2144000 bit/s of link spi:/dev/spidev0.0@1000000, which has "
        "750000 for them; write a higher speed, such as spi:/dev/spidev0.0@2858667, if the board bears it, lower "
        "max_velocity_mm_s, or connect some motors to another board\n");
}

/// As docs/fpga.md says.
TEST(BoardLinks, AnSpiCarriesAsManyMotorsAsItsDocumentSays) {
    const auto suits = [](const char* link, int motors, int steps_per_s, const char* homing = "") {
        std::string text =
            "name: \"m\" tick_ns: 50000 timing { slot_us: 40000 stall_slots: 2 late_check_slots: 1 "
            "freshness_slots: 3 send_ahead_slots: 14 frame_slots: 5 clock_error_limit_us: 5000 "
            "segment_entries: 192 output_entries: 24 }\n";
        for (int n = 0; n < motors; ++n) {
            text += fmt::format(
                "axis {{ name: \"A{0}\" device: \"board:f/{0}\" steps_per_mm: 50 start_velocity_mm_s: 1 "
                "max_velocity_mm_s: {1} max_accel_mm_s2: 500 position_min_mm: 0 position_max_mm: 9 {2} }}\n",
                n, steps_per_s / 50, homing);
        }
        const auto read = parse_machine(text + "board { name: \"f\" link: \"" + link + "\" }");
        if (!read) { EXPECT_THAT(to_text("m", read.error()), HasSubstr("bit/s of link")); }
        return read.has_value();
    };
    EXPECT_TRUE(suits("spi:/dev/spidev0.0", 3, 9'800)) << "as fast as a plan with ticks of 50 us can be";
    EXPECT_FALSE(suits("spi:/dev/spidev0.0", 4, 9'800));
    EXPECT_TRUE(suits("spi:/dev/spidev0.0@6250000", 4, 9'800));
    EXPECT_TRUE(suits("spi:/dev/spidev0.0@6250000", 8, 3'000));
    // Homing needs more than a program of such long slots: 8 * (5,000 * 80 + 200 * 14 * 80 + 25 * 48 * 80) bit/s.
    EXPECT_FALSE(suits("spi:/dev/spidev0.0@6250000", 8, 5'000));
    EXPECT_TRUE(suits("spi:/dev/spidev0.0@6250000", 8, 5'000, "homing { in_place: true }"));
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
