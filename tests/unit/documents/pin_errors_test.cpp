// The errors in `pins`, and what they mean when they are right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/hardware/device_abilities.hpp"
#include "core/kinematics/motors.hpp"
#include "services/documents/machine_file.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

/// One axis that makes a step every 100 us at its greatest speed.
std::string one_axis(const std::string& keys) {
    return "name: \"m\" axis { name: \"X\" steps_per_mm: 100 start_velocity_mm_s: 10 max_velocity_mm_s: 100 "
           "max_accel_mm_s2: 1000 position_min_mm: 0 position_max_mm: 100\n" +
           keys + " }\n";
}
std::string two_motors(const std::string& first, const std::string& second) {
    return one_axis("max_skew_mm: 3 pins { step_width_us: 4 } motor { name: \"X1\" " + first +
                    " } motor { name: \"X2\" " + second + " }");
}

std::string error_of_pins(const std::string& text) {
    const auto read = parse_machine(text);
    return read ? "no error" : to_text("m", read.error());
}

TEST(Pins, WrongValuesAreRefusedWithPlaceValueAndRemedy) {
    const std::pair<std::string, std::string> mistakes[] = {
        {one_axis("pins { step_width_us: -1 }"), "pins.step_width_us is -1; it must be from 0 to 1000"},
        {one_axis("pins { direction_setup_us: 1001 }"), "pins.direction_setup_us is 1001; it must be from 0 to 1000"},
        {one_axis("pins { direction_hold_us: nan }"), "pins.direction_hold_us is nan; it must be from 0 to 1000"},
        {one_axis("pins { enable_wait_ms: 10001 }"), "pins.enable_wait_ms is 10001; it must be from 0 to 10000"},
        {one_axis("pins { step_width_us: 50.1 }"),
         "step_width_us is 50.1, and motor X makes steps 100 us apart at max_velocity_mm_s 100: a pulse and the time "
         "to "
         "the next are longer; it must be at most 50, or decrease max_velocity_mm_s or steps_per_mm"},
        {one_axis("pins { direction_setup_us: 60 direction_hold_us: 41 }"),
         "direction_setup_us and direction_hold_us are 101 together, and motor X makes steps 100 us apart"},
        {two_motors("pins { step_width_us: 70 }", ""), "step_width_us is 70, and motor X1 makes steps"},
        {two_motors("", "pins { direction_hold_us: 2000 }"), "motor[1].pins.direction_hold_us is 2000"}};
    for (const auto& [text, message] : mistakes) {
        const std::string found = error_of_pins(text);
        EXPECT_THAT(found, HasSubstr(message));
        EXPECT_THAT(found, testing::MatchesRegex("m:[0-9]+:[0-9]+: [^\n]*\n?")) << "one error, with its place";
    }
}

TEST(Pins, ThatJustFitAreAccepted) {
    EXPECT_EQ(error_of_pins(one_axis("pins { step_width_us: 50 direction_setup_us: 60 direction_hold_us: 40 }")),
              "no error");
}

TEST(Pins, OfAnAxisAreThoseOfItsMotorsThatHaveNone) {
    const auto read = parse_machine(two_motors("", "pins { step_inverted: true }"));
    ASSERT_TRUE(read);
    const std::vector<MotorConfig> motors = motors_of(*read);
    EXPECT_EQ(motors[0].pins, (PinsConfig{.step_width_us = 4}));
    EXPECT_EQ(motors[1].pins, (PinsConfig{.step_inverted = true}));
}

TEST(Pins, BecomeTheSetupOfTheDevice) {
    const auto read = parse_machine(
        one_axis("pins { step_width_us: 2.5 direction_setup_us: 5 direction_hold_us: 0.2 enable_wait_ms: 200 "
                 "step_inverted: true direction_inverted: true enable_inverted: true }"));
    ASSERT_TRUE(read);
    EXPECT_EQ(setup_of(*read, motors_of(*read)[0]), (DeviceSetup{.step_width_ns = 2500,
                                                                 .direction_setup_ns = 5000,
                                                                 .direction_hold_ns = 200,
                                                                 .enable_wait = Ticks{200'000},
                                                                 .step_inverted = true,
                                                                 .direction_inverted = true,
                                                                 .enable_inverted = true}));
}

TEST(Pins, ThatAreWrittenAreReadAgain) {
    const auto read = parse_machine(one_axis("pins { step_width_us: 2.5 enable_inverted: true }"));
    ASSERT_TRUE(read);
    const auto again = parse_machine(machine_text(*read));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->axes[0].pins, read->axes[0].pins);
}

}  // namespace
}  // namespace lockstep
