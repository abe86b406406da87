// The figures of deploy/scale.md that follow from counts and sizes of messages.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include "services/wire/dds/dds_pace.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

constexpr int kProcesses = 33;  // 32 axes and the coordinator
constexpr int kMachines = 32;
constexpr double kSlots_s = 100;                                           // of 10 ms
constexpr double kStateBytes = 350;                                        // as the document states
constexpr double kStepBytes = sizeof(std::int32_t) + sizeof(std::int8_t);  // step_batch_t: delta_ticks, direction

std::string document() {
    std::ifstream file("deploy/scale.md");
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The number, rounded to significant digits, with a comma before each three digits.
std::string rounded(double value, int digits) {
    const double unit = std::pow(10, std::floor(std::log10(value)) + 1 - digits);
    std::string text = fmt::format("{:g}", std::round(value / unit) * unit);
    for (auto at = static_cast<std::ptrdiff_t>(std::min(text.find('.'), text.size())) - 3; at > 0; at -= 3) {
        text.insert(static_cast<std::size_t>(at), ",");
    }
    return text;
}

std::string row(const std::string& what, double of_one_machine, int digits_of_one, int digits_of_all) {
    return "| " + what + " | " + rounded(of_one_machine, digits_of_one) + " | " +
           rounded(kMachines * of_one_machine, digits_of_all) + " |";
}

TEST(ScaleDocument, CountsStatesAndSteps) {
    const double states_s = kProcesses * kSlots_s;
    EXPECT_THAT(document(), HasSubstr(row("states, messages a second", states_s, 2, 3)));
    EXPECT_THAT(document(), HasSubstr(row("states, Mbit/s", states_s * kStateBytes * 8 / 1e6, 2, 2)));
    const double steps_s = (kProcesses - 1) * 10'000;
    EXPECT_THAT(document(), HasSubstr(row("steps on record (LCM), each axis at 10,000 steps/s, Mbit/s",
                                          steps_s * kStepBytes * 8 / 1e6, 2, 2)));
    EXPECT_THAT(document(), HasSubstr(fmt::format("32 axes at 100,000 steps/s are {} MB/s",
                                                  rounded(10 * steps_s * kStepBytes / 1e6, 2))));
}

TEST(ScaleDocument, CountsAnnouncements) {
    std::smatch period;
    const std::string pace = discovery_pace(kProcesses);
    ASSERT_TRUE(std::regex_search(pace, period, std::regex("<SPDPInterval>(\\d+) ms")));
    const double announcements_s = kProcesses * 1000 / std::stod(period[1]);
    const std::string text = std::regex_replace(document(), std::regex("\\s+"), " ");
    EXPECT_THAT(text, HasSubstr("announces itself every " + period[1].str() + " ms"));
    EXPECT_THAT(text, HasSubstr("That makes " + rounded(announcements_s, 2) + " announcements a second"));
    EXPECT_THAT(text, HasSubstr("in one domain would make " + rounded(kMachines * announcements_s, 3) +
                                ", and each of their " + rounded(kMachines * kProcesses, 4) + " processes"));
}

}  // namespace
}  // namespace lockstep
