// The errors in a configuration: their place and message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <regex>

#include "core/number_text.hpp"
#include "services/documents/machine_file.hpp"
#include "tests/unit/documents/machine_text_examples.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

Diagnostics errors(const std::string& text) {
    const auto machine = parse_machine(text);
    return machine ? Diagnostics{} : machine.error();
}

struct Refusal {
    std::string text;
    int line;
    int column;
    std::string message;
    friend void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.message; }
};

class MachineRefused : public testing::TestWithParam<Refusal> {};

TEST_P(MachineRefused, WithPlaceValueAndRemedy) {
    const Refusal& refusal = GetParam();
    const Diagnostics found = errors(refusal.text);
    ASSERT_EQ(found.size(), 1U) << refusal.text << "\n" << to_text("machine", found);
    EXPECT_EQ(found[0].line, refusal.line) << found[0].message;
    EXPECT_EQ(found[0].column, refusal.column) << found[0].message;
    EXPECT_THAT(found[0].message, HasSubstr(refusal.message));
}

INSTANTIATE_TEST_SUITE_P(Syntax, MachineRefused,
                         testing::Values(Refusal{machine_with("tick_nanos: 5"), 11, 11, "tick_nanos"},
                                         Refusal{axis_with("max_velocty_mm_s: 5"), 10, 19, "max_velocty_mm_s"},
                                         Refusal{axis_with("homing { dir: 1 }"), 10, 15, "dir"},
                                         Refusal{machine_with("name: \"other\""), 11, 5, "multiple times"},
                                         Refusal{axis_with("steps_per_mm: 5"), 10, 15, "multiple times"},
                                         Refusal{axis_with("homing { toward_min: flase }"), 10, 30, "flase"},
                                         Refusal{machine_with("tick_ns: 1.5"), 11, 10, "1.5"},
                                         Refusal{machine_with("tick_ns: \"1\""), 11, 10, "integer"},
                                         Refusal{with("80", "eighty"), 4, 17, "eighty"},
                                         Refusal{"axis {\n", 2, 1, "Expected"},
                                         Refusal{"\x7f"
                                                 "ELF\x02\x01",
                                                 1, 1, "Expected identifier"}));

INSTANTIATE_TEST_SUITE_P(Missing, MachineRefused,
                         testing::Values(Refusal{with("name: \"m\"", ""), 1, 1, "name is missing"},
                                         Refusal{"name: \"m\"", 1, 1, "0 axes; it must have"},
                                         Refusal{with("  steps_per_mm: 80\n", ""), 2, 1, "steps_per_mm is missing"},
                                         Refusal{with("  position_max_mm: 200\n", ""), 2, 1,
                                                 "position_max_mm is missing"}));

INSTANTIATE_TEST_SUITE_P(
    Machine, MachineRefused,
    testing::Values(
        Refusal{with("\"m\"", "\"\""), 1, 1, "a letter, then"},
        Refusal{with("\"m\"", "\"my machine\""), 1, 1, "my machine"},
        Refusal{with("\"m\"", "\"m234567890123456789012345\""), 1, 1, "at most 24"},
        Refusal{machine_with("tick_ns: 99"), 11, 1, "100 to 1000000"},
        Refusal{machine_with("timing { slot_us: 10001 }\ntick_ns: 3000"), 11, 10, "whole number of ticks"},
        Refusal{with("80", "1", machine_with("timing { slot_us: 3000 }\ntick_ns: 1000000")), 11, 10,
                "at least 4000, 4 ticks of 1000000 ns"},
        Refusal{machine_with("timing { slot_us: 499 }"), 11, 10, "500 to 1000000"},
        Refusal{machine_with("timing { stall_slots: 0 }"), 11, 10, "1 to 200"},
        Refusal{machine_with("timing { freshness_slots: 10 }"), 11, 10, "at least 11 (stall_slots + 1)"},
        Refusal{machine_with("timing { send_ahead_slots: 30 }"), 11, 10, "at least 31"},
        Refusal{machine_with("timing { frame_slots: 3 }"), 11, 10, "at least 4, so that a device has room"},
        Refusal{machine_with("timing { segment_entries: 53 }"), 11, 10, "54 to 4096"},
        Refusal{machine_with("timing { segment_entries: 200 }"), 11, 1, "at least 6, so that a device has room in 200"},
        Refusal{machine_with("timing { output_entries: 15 }"), 11, 10, "16 to 1024"},
        Refusal{
            machine_with("timing { output_entries: 47 }\noutput { name: \"air\" motor: \"X\" channel: 0 use: MIST }"),
            11, 10, "is 47; it must be at least 48, for 3 changes in the body and 3 in the tail of each of 8 frames"},
        Refusal{machine_with("timing { jog_hold_ms: 19 }"), 11, 10, "20 to 500"},
        Refusal{machine_with("timing { jog_hold_ms: 501 }"), 11, 10, "20 to 500"},
        Refusal{machine_with("timing { late_check_slots: 11 send_ahead_slots: 40 }"), 11, 10, "0 to stall_slots, 10"},
        Refusal{machine_with("timing { time_source: NETWORK clock_error_limit_us: 2501 }"), 11, 31,
                "is 2501; it must be from 1 to 2500 (a quarter of slot_us)"},
        Refusal{machine_with("timing { time_source: PTP clock_error_limit_us: 0 }"), 11, 27, "1 to 2500"},
        Refusal{machine_with("timing { time_source: LOCAL }"), 11, 29, "LOCAL"},
        Refusal{machine_with("record { directory: \"logs\" }"), 11, 10, "an absolute path"},
        Refusal{machine_with("position_directory: \"places\""), 11, 1, "an absolute path"},
        Refusal{machine_with("subroutine_directory: \"parts\""), 11, 1, "an absolute path"},
        Refusal{machine_with("unassigned { spindle: WARN }"), 11, 28, "WARN"},
        Refusal{machine_with("unattended_job: STOP"), 12, 1, "STOP"},
        Refusal{machine_with("security { directory: \"keys\" }"), 11, 12, "an absolute path"},
        Refusal{machine_with("security { }"), 11, 1, "security.directory is missing"},
        Refusal{machine_with("record { size_limit_mb: 0 }"), 11, 10, "1 to 1000000"},
        Refusal{machine_with("record { flight { memory_kb: 1 } }"), 11, 19, "from 64 to 65536"},
        Refusal{machine_with("record { flight { files: 0 } }"), 11, 19, "from 1 to 1000"},
        Refusal{machine_with("network { interface: \"\" }"), 11, 11, "name an interface"},
        Refusal{machine_with("network { interface: \"<lo>\" }"), 11, 11, "<lo>"},
        Refusal{machine_with("network { domain: 233 }"), 11, 11, "0 to 232"},
        Refusal{machine_with("network { lcm_url: \"239.255.76.67\" }"), 11, 11, "udpm://"},
        Refusal{machine_with("network { peers: \"10.0.0.1 10.0.0.2\" }"), 11, 1, "an IPv4 address or a"},
        Refusal{machine_with("network { one_host: true peers: \"10.0.0.1\" }"), 11, 11, "remove one of them"}));

INSTANTIATE_TEST_SUITE_P(
    Web, MachineRefused,
    testing::Values(Refusal{machine_with("web { port: 0 }"), 11, 7, "web.port is 0; it must be from 1 to 65535"},
                    Refusal{machine_with("web { address: \"localhost\" }"), 11, 7, "an IP address, such as 127.0.0.1"},
                    Refusal{machine_with("web { address: \"0.0.0.0\" }"), 11, 7, "with TLS only; add certificate_file"},
                    Refusal{machine_with("web { address: \"::\" }"), 11, 7, "with TLS only"},
                    Refusal{machine_with("web { certificate_file: \"/a.crt\" }"), 11, 1, "web.key_file is missing"},
                    Refusal{machine_with("web { key_file: \"/a.key\" }"), 11, 1, "web.certificate_file is missing"},
                    Refusal{machine_with("web { certificate_file: \"a.crt\" key_file: \"/a\" }"), 11, 7,
                            "an absolute path"},
                    Refusal{machine_with("web { host_names: \"a b\" }"), 11, 1, "web.host_names has \"a b\""}));

INSTANTIATE_TEST_SUITE_P(
    Hosts, MachineRefused,
    testing::Values(Refusal{axis_with("host: \"a b\""), 10, 3, "host is \"a b\"; it must be the name of a host"},
                    Refusal{axis_with("device: \"usb\""), 10, 3, "sim, shm:NAME, uio:PATH or board:NAME"},
                    Refusal{axis_with("device: \"uio:uio0\""), 10, 3, "such as uio:/dev/uio0"},
                    Refusal{axis_with("device: \"uio:/dev/uio0\"") + "timing { time_source: PTP }", 12, 10,
                            "leaves no room for the clock error of device uio:/dev/uio0 of axis X; set NETWORK"},
                    Refusal{machine_with("coordinator_host: \"-\""), 11, 1, "the name of a host"},
                    Refusal{machine_with("real_time { priority: 100 }"), 11, 13, "0 to 99"},
                    Refusal{machine_with("real_time { cpus: 0 cpus: 1024 }"), 11, 1, "has 1024"},
                    Refusal{axis_with("host: \"a\"") + "coordinator_host: \"b\" network { interface: \"eth0\" }", 1, 1,
                            "the clock of one host, but the machine is on several hosts, such as b and a"},
                    Refusal{axis_with("host: \"a\"") + "coordinator_host: \"b\" timing { time_source: NETWORK }", 1, 1,
                            "network.interface is lo, but"},
                    Refusal{axis_with("host: \"a\"") + "coordinator_host: \"b\" timing { time_source: NETWORK } "
                                                       "network { interface: \"eth0\" one_host: true }",
                            12, 83, "network.one_host is true, but the machine is on several hosts"}));

INSTANTIATE_TEST_SUITE_P(
    Method, MachineRefused,
    testing::Values(Refusal{axis_with("method: STEPPER"), 11, 1, "STEPPER"},
                    Refusal{axis_with("method: 9"), 10, 3, "method is 9; it must be one of RANADE, SPIELAUER"},
                    Refusal{axis_with("method: CARRICA max_decel_mm_s2: 1000"), 10, 3,
                            "80000 steps/s^2 must equal the acceleration, 120000"},
                    Refusal{axis_with("method: LAM"), 10, 3, "method is lam; in a move of"},
                    Refusal{axis_with("method: LAI"), 10, 3, "makes a jump of speed of"},
                    Refusal{axis_with("method: LAI max_decel_mm_s2: 290"), 10, 3, "at least 23668.6 steps/s^2"},
                    Refusal{with("150", "500", axis_with("method: LAI")), 10, 3, "1 to 255 whole pulses"},
                    Refusal{with("\"m\"", "\"m\" tick_ns: 40000", axis_with("method: SPIELAUER")), 10, 3,
                            "a third of a step per tick"}));

INSTANTIATE_TEST_SUITE_P(
    Axis, MachineRefused,
    testing::Values(Refusal{with("\"X\"", "\"1st\""), 3, 3, "a letter, then"},
                    Refusal{with("\"X\"", "\"X23456789012345678\""), 3, 3, "at most 16"},
                    Refusal{with("80", "0"), 4, 3, "steps_per_mm is 0"},
                    Refusal{with("80", "nan"), 4, 3, "steps_per_mm is nan"},
                    Refusal{with("150", "inf"), 6, 3, "max_velocity_mm_s is inf"},
                    Refusal{with("10\n", "-10\n"), 5, 3, "start_velocity_mm_s is -10"},
                    Refusal{with("150", "9"), 6, 3, "below start_velocity_mm_s 10"},
                    Refusal{with("150", "6126"), 6, 3, "more than 0.49 steps per tick; it must be at most 6125"},
                    Refusal{with("1500", "0"), 7, 3, "max_accel_mm_s2 is 0"},
                    Refusal{with("1500", "-1"), 7, 3, "is -1"}, Refusal{with("1500", ".01"), 7, 3, "more than 600 s"},
                    Refusal{axis_with("max_decel_mm_s2: 0"), 10, 3, "is 0"},
                    Refusal{with("200", "0"), 9, 3, "not above position_min_mm 0"},
                    Refusal{with("200", "-5"), 9, 3, "position_max_mm is -5"},
                    Refusal{with("200", "2e6"), 9, 3, "-1000000 to 1000000"}));

INSTANTIATE_TEST_SUITE_P(
    Homing, MachineRefused,
    testing::Values(
        Refusal{axis_with("homing { search_velocity_mm_s: 11 }"), 10, 12, "the switch stops the pulses at once"},
        Refusal{axis_with("homing { search_velocity_mm_s: 0 }"), 10, 12, "is 0"},
        Refusal{with("200", "2000", axis_with("homing { search_velocity_mm_s: .001 latch_velocity_mm_s: .001 }")), 10,
                12, "so twice the travel would take more than 30 days; it must be at least 0.00154"},
        Refusal{axis_with("homing { latch_velocity_mm_s: 10.5 }"), 10, 12, "above homing.search_velocity_mm_s 10"},
        Refusal{axis_with("homing { pulloff_mm: 0 }"), 10, 12, "above 0"},
        Refusal{axis_with("homing { pulloff_mm: .01 }"), 10, 12, "less than a step"},
        Refusal{axis_with("homing { pulloff_mm: 200 }"), 10, 12, "the travel from the switch"},
        Refusal{axis_with("homing { touch_tolerance_mm: 2 }"), 10, 12, "not less than homing.pulloff_mm 2"},
        Refusal{axis_with("homing { touch_tolerance_mm: 0 }"), 10, 12, "above 0"},
        Refusal{axis_with("homing { switch_position_mm: 101 }"), 10, 12, "-2 to 100"},
        Refusal{axis_with("homing { switch_position_mm: -2 }"), 10, 12, "not on the limit switch"},
        Refusal{axis_with("homing { toward_min: false switch_position_mm: 0 }"), 10, 30, "100 to 202"},
        Refusal{axis_with("homing { park_mm: 201 }"), 10, 12, "outside the travel; it must be from 0 to 200"},
        Refusal{axis_with("unhomed_jog_mm_s: 11"), 10, 3, "above start_velocity_mm_s 10"},
        Refusal{axis_with("unhomed_jog_mm_s: 0"), 10, 3, "is 0"},
        Refusal{axis_with("safe_height_mm: 201"), 10, 3, "outside the travel; it must be from 0 to 200"},
        Refusal{axis_with("plant { start_position_mm: 202 }"), 10, 11,
                "between the limit switches; it must be above -2 and below 202"},
        Refusal{axis_with("plant { travel_margin_mm: 0 }"), 10, 11, "from 1e-09 to 1000000"},
        Refusal{axis_with("plant { probe_at_mm: 202 }"), 10, 11, "must be above -2, below 202"},
        Refusal{axis_with("plant { start_position_mm: 9 probe_at_mm: 9 }"), 10, 32, "not at plant.start_position_mm"},
        Refusal{axis_with("plant { max_jump_mm_s: nan }"), 10, 11, "nan"}));

TEST(MachineErrors, ReportsEveryErrorInTheOrderOfTheText) {
    const Diagnostics found = errors(machine_with("tick_ns: 5") +
                                     "axis {\n  name: \"x\"\n}\naxis { name: \"Y\"\n"
                                     "steps_per_mm: -1 start_velocity_mm_s: 10 max_velocity_mm_s: 5\n"
                                     "max_accel_mm_s2: 100 position_min_mm: 5 position_max_mm: 4 }\n");
    ASSERT_EQ(found.size(), 10U) << to_text("machine", found);
    EXPECT_THAT(found[0].message, HasSubstr("tick_ns"));
    EXPECT_EQ(found[1].line, 12) << "six keys are missing from the second axis";
    EXPECT_THAT(found[7].message, HasSubstr("axis Y: steps_per_mm is -1"));
    EXPECT_THAT(found[8].message, HasSubstr("max_velocity_mm_s is 5"));
    EXPECT_THAT(found[9].message, HasSubstr("position_max_mm is 4"));
}

TEST(MachineErrors, NoTwoAxesHaveOneNameInAnyCapitals) {
    const std::string axis(kShortest.substr(kShortest.find("axis")));
    const Diagnostics found = errors(machine_with(with("\"X\"", "\"x\"", axis)));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].line, 12);
    EXPECT_THAT(found[0].message, HasSubstr("already that of axis 1, X"));
}

TEST(MachineErrors, ThereAreAtMost32Axes) {
    const std::string axis(kShortest.substr(kShortest.find("axis")));
    std::string text = "name: \"m\"\n";
    for (int i = 0; i < 65; ++i) { text += with("\"X\"", "\"X" + std::to_string(i) + "\"", axis); }
    const Diagnostics found = errors(text);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_THAT(found[0].message, HasSubstr("65 axes; it must have from 1 to 64: write one axis { ... } for each"));
}

/// The texts of keys of one axis. Others have their presets.
using AxisTexts = std::map<std::string, std::string>;

Diagnostics errors_of(std::int64_t tick_ns, const AxisTexts& texts) {
    std::string axis = "name: \"m\" tick_ns: " + std::to_string(tick_ns) + " axis { name: \"X\"";
    for (const auto& [key, text] : texts) { axis += " " + key + ": " + text; }
    return errors(axis + " }");
}

/// Replaces the value that the message refuses by the limit that it names.
bool takes_limit_of(const std::string& message, AxisTexts& texts) {
    static const std::regex kLimit("axis X: ([a-z0-9_]+) is .*must be at (?:most|least) ([-+.e0-9]*[0-9])");
    std::smatch found;
    if (!std::regex_search(message, found, kLimit) || !texts.contains(found[1])) { return false; }
    texts[found[1]] = found[2];
    return true;
}

TEST(MachineErrors, NameALimitThatIsAccepted) {
    std::mt19937_64 random(3);
    for (int run = 0; run < 400; ++run) {
        const double steps_per_mm = 0.5 * std::pow(1e4, static_cast<double>(random() % 10'000) * 1e-4);
        AxisTexts texts{{"steps_per_mm", number_text(steps_per_mm, 17)},
                        {"start_velocity_mm_s", "0.1"},
                        {"max_velocity_mm_s", "1e6"},
                        {"max_accel_mm_s2", run % 2 == 0 ? "1e9" : "0.001"},
                        {"position_min_mm", "0"},
                        {"position_max_mm", "100"}};
        const std::int64_t tick_ns = run % 3 == 0 ? 1000 : run % 3 == 1 ? 100 : 200'000;
        Diagnostics found = errors_of(tick_ns, texts);
        ASSERT_FALSE(found.empty());
        for (int copied = 0; copied < 3 && !found.empty(); ++copied) {
            ASSERT_TRUE(takes_limit_of(found.front().message, texts)) << found.front().message;
            found = errors_of(tick_ns, texts);
        }
        EXPECT_TRUE(found.empty()) << to_text("machine", found);
    }
}

}  // namespace
}  // namespace lockstep
