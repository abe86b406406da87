// Which of a board's lines has its host.
#include <gtest/gtest.h>

#include "sim_fpga/firmware/link/line_choice.hpp"
#include "sim_fpga/firmware/link/link.hpp"

namespace lockstep::testing {
namespace {

using firmware::LineChoice;
using enum firmware::LineChoice::Verdict;

constexpr std::size_t kUart = 0, kUsb = 1;

TEST(LineChoice, ServesTheLineThatSpeaksFirst) {
    LineChoice choice;
    EXPECT_EQ(choice.take(kUsb, 5), Changed);
    EXPECT_EQ(choice.take(kUsb, 10), Same);
    EXPECT_EQ(choice.line(), kUsb);
}

TEST(LineChoice, HasAHostUntilItIsSilent) {
    LineChoice choice;
    EXPECT_FALSE(choice.has_host(1));
    choice.take(kUsb, 5);
    EXPECT_TRUE(choice.has_host(4 + LineChoice::kPatience_us));
    EXPECT_FALSE(choice.has_host(5 + LineChoice::kPatience_us));
}

TEST(LineChoice, IgnoresASecondHostWhileTheFirstOneSpeaks) {
    LineChoice choice;
    for (std::uint32_t now_us = 0; now_us < 1'000'000; now_us += 5'000) {
        EXPECT_EQ(choice.take(kUart, now_us), Same);
        EXPECT_EQ(choice.take(kUsb, now_us + 1), Ignored);
    }
    EXPECT_EQ(choice.line(), kUart);
}

TEST(LineChoice, ServesTheSecondHostWhenTheFirstOneIsSilent) {
    constexpr std::uint32_t kNearWrap_us = 0xFFFF'FF00;
    LineChoice choice;
    EXPECT_EQ(choice.take(kUart, kNearWrap_us), Same);
    EXPECT_EQ(choice.take(kUsb, kNearWrap_us + LineChoice::kPatience_us - 1), Ignored);
    EXPECT_EQ(choice.take(kUsb, kNearWrap_us + LineChoice::kPatience_us), Changed);
    EXPECT_EQ(choice.take(kUart, kNearWrap_us + LineChoice::kPatience_us + 1), Ignored);
}

TEST(LineChoice, DoesNotTakeAPauseOfTheLinkForSilence) {
    EXPECT_GT(LineChoice::kPatience_us, 4 * firmware::Link::kRepeat_us);
    EXPECT_GT(LineChoice::kPatience_us, 10 * firmware::Link::kIdle_us);
}

}  // namespace
}  // namespace lockstep::testing
