// A machine file that is accepted describes a machine that works. A refusal says what to change.
//
// LOCKSTEP_MACHINES=N draws N machines per test instead of kMachines or a part of them, and LOCKSTEP_FIRST_MACHINE=N
// begins at seed N.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <set>

#include "services/documents/machine_file.hpp"
#include "services/documents/rules/machine_warnings.hpp"
#include "tests/property/machines/machine_trial.hpp"
#include "tests/property/machines/random_machine.hpp"
#include "tests/random_seeds.hpp"

namespace lockstep {
namespace {

constexpr std::uint64_t kMachines = 120;
constexpr std::uint64_t kTests = 8;

std::uint64_t number_of(const char* variable, std::uint64_t preset) {
    const char* text = std::getenv(variable);
    return text != nullptr ? std::strtoull(text, nullptr, 10) : preset;
}

std::set<std::string> keys_of(const std::string& text) {
    static const std::regex kKey("([a-z][a-z0-9_]*):|([a-z]+) \\{");
    std::set<std::string> keys;
    for (std::sregex_iterator i(text.begin(), text.end(), kKey), end; i != end; ++i) {
        keys.insert((*i)[1].matched ? (*i)[1] : (*i)[2]);
    }
    return keys;
}

/// Whether a person finds in the message a key that the file has, a value, and what to do.
bool is_of_use(const std::string& message, const std::set<std::string>& keys) {
    static const std::regex kRemedy("must be|must equal|crease|choose|lower|move it|needs|change");
    const bool names_key =
        std::ranges::any_of(keys, [&](const std::string& key) { return message.find(key) != std::string::npos; });
    return names_key && std::regex_search(message, kRemedy) && std::regex_search(message, std::regex("[0-9]"));
}

class RandomMachineFiles : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomMachineFiles, AreRefusedWithARemedyOrHomeAndRunJobsExactly) {
    const std::uint64_t count = number_of("LOCKSTEP_MACHINES", random_cases(kMachines));
    const std::uint64_t first = number_of("LOCKSTEP_FIRST_MACHINE", 1) + GetParam() * count;
    std::uint64_t tried = 0;
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        const std::string text = random_machine(seed);
        const auto machine = parse_machine(text);
        if (!machine) {
            for (const Diagnostic& error : machine.error()) {
                EXPECT_TRUE(is_of_use(error.message, keys_of(text))) << seed << ": " << error.message << "\n" << text;
            }
            continue;
        }
        const bool is_warned_of = !machine_warnings(*machine).empty();  // its simulated motor is too weak
        if (is_warned_of || !cost_of_trial(*machine).is_small()) { continue; }
        ++tried;
        EXPECT_EQ(trouble_of(*machine, seed), "") << "machine " << seed << "\n" << text;
    }
    RecordProperty("tried", std::to_string(tried));
    EXPECT_GE(tried, count / 20);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomMachineFiles, testing::Range(std::uint64_t{0}, kTests));

std::string machine_file(const std::string& machine, const std::string& axis) {
    return "name: \"m\" " + machine + " axis { name: \"X\" " + axis + " }";
}

void expect_usable(const std::string& text) {
    const auto machine = parse_machine(text);
    ASSERT_TRUE(machine) << machine.error().front().message;
    EXPECT_EQ(trouble_of(*machine, 1), "") << text;
}

TEST(MachineFile, WithAStartVelocityThatOneTickOfAccelerationReachesIsUsable) {
    for (const char* accel : {"10", "200", "1000", "6000"}) {
        expect_usable(machine_file("tick_ns: 1000000",
                                   std::string("steps_per_mm: 80 start_velocity_mm_s: 0.26 max_velocity_mm_s: 5 "
                                               "position_min_mm: 0 position_max_mm: 20 "
                                               "homing { park_mm: 1 } plant { start_position_mm: 0.5 } "
                                               "max_accel_mm_s2: ") +
                                       accel));
    }
}

constexpr const char* kSpeeds = "start_velocity_mm_s: 10 max_velocity_mm_s: 150 max_accel_mm_s2: 1500 ";

TEST(MachineFile, WithTravelThatEndsOffTheStepGridIsUsable) {
    for (const char* margin : {"0.001", "1e-9", "2"}) {
        expect_usable(machine_file("", std::string(kSpeeds) +
                                           "steps_per_mm: 80 position_min_mm: 0.003 position_max_mm: "
                                           "20.0041 plant { start_position_mm: 1.0017 "
                                           "travel_margin_mm: " +
                                           margin + " }"));
    }
}

/// Its moves along X round the place of Y, the pulses and in each period the share of Y.
TEST(MachineFile, ThatCoordinatesByLaiAndParksOffTheStepGridIsUsable) {
    expect_usable(
        "name: \"m\" coordination: LAI "
        "axis { name: \"X\" steps_per_mm: 40 start_velocity_mm_s: 20 max_velocity_mm_s: 200 max_accel_mm_s2: 3500 "
        "position_min_mm: 0 position_max_mm: 1000 homing { park_mm: 5 } plant { start_position_mm: 1 } } "
        "axis { name: \"Y\" steps_per_mm: 5 start_velocity_mm_s: 160 max_velocity_mm_s: 160 max_accel_mm_s2: 20000 "
        "position_min_mm: 0 position_max_mm: 1000 homing { park_mm: 30.08 } plant { start_position_mm: 1 } }");
}

TEST(MachineFile, WithStepsLongerThanTheMarginIsUsable) {
    expect_usable(machine_file("",
                               "steps_per_mm: 0.01 start_velocity_mm_s: 1000 max_velocity_mm_s: 20000 "
                               "max_accel_mm_s2: 50000 position_min_mm: 0 position_max_mm: 10000"));
}

TEST(MachineFile, WithTheFewestTicksInASlotIsUsable) {
    expect_usable(machine_file("tick_ns: 1000000 timing { slot_us: 4000 frame_slots: 40 }",
                               "steps_per_mm: 80 start_velocity_mm_s: 0.26 max_velocity_mm_s: 5 max_accel_mm_s2: 200 "
                               "position_min_mm: 0 position_max_mm: 20 homing { park_mm: 1 } "
                               "plant { start_position_mm: 0.5 }"));
}

/// Its speed is as near to that of a device as may be, and it reaches it within a few ticks.
TEST(MachineFile, WithTheGreatestSpeedOfADeviceAfterAFewTicksIsUsable) {
    for (const char* accel : {"2e4", "1e5", "4e5"}) {
        expect_usable(machine_file("tick_ns: 100000",
                                   std::string("steps_per_mm: 100 start_velocity_mm_s: 40 max_velocity_mm_s: 49 "
                                               "position_min_mm: 0 position_max_mm: 200 max_accel_mm_s2: ") +
                                       accel));
    }
}

TEST(MachineFile, WithTheGreatestValuesNeedsNoKeysOfThePlant) {
    EXPECT_TRUE(parse_machine(machine_file("",
                                           "steps_per_mm: 80 start_velocity_mm_s: 10 max_velocity_mm_s: 150 "
                                           "max_accel_mm_s2: 1e9 position_min_mm: 0 position_max_mm: 20")));
    EXPECT_TRUE(parse_machine(machine_file("tick_ns: 100",
                                           "steps_per_mm: 0.01 start_velocity_mm_s: 1e6 "
                                           "max_velocity_mm_s: 1e6 max_accel_mm_s2: 1e6 "
                                           "position_min_mm: 0 position_max_mm: 2e5")));
    EXPECT_TRUE(parse_machine(machine_file("",
                                           "steps_per_mm: 80 start_velocity_mm_s: 0.001 max_velocity_mm_s: 150 "
                                           "max_accel_mm_s2: 1500 position_min_mm: 0 position_max_mm: 20")));
}

TEST(MachineFile, WithADeviceThatCannotRecordAllStepsOfAStallIsRefused) {
    const auto machine = parse_machine(
        machine_file("timing { slot_us: 100000 }", std::string(kSpeeds) + "steps_per_mm: 2000 position_min_mm: 0 "
                                                                          "position_max_mm: 20"));
    ASSERT_FALSE(machine);
    EXPECT_NE(machine.error().front().message.find("it must be at most 29.789"), std::string::npos)
        << machine.error().front().message;
}

}  // namespace
}  // namespace lockstep
