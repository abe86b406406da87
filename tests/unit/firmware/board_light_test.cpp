// What the light of a board shows.
#include "sim_fpga/firmware/link/board_light.hpp"

#include <gtest/gtest.h>

#include <string>

namespace lockstep::testing {
namespace {

using firmware::BoardLight;
using enum firmware::BoardLight::State;

constexpr std::uint32_t kSlot_us = 1 << 16;

/// The 16 slots from this time on: # where the light is on.
std::string pattern(BoardLight& light, BoardLight::State state, std::uint32_t from_us) {
    std::string shown;
    for (std::uint32_t slot = 0; slot < 16; ++slot) {
        shown += light.is_on(state, from_us + slot * kSlot_us) ? '#' : '.';
    }
    return shown;
}

TEST(BoardLight, ShowsItsState) {
    BoardLight light;
    EXPECT_EQ(pattern(light, Alone, 0), "#...............");
    EXPECT_EQ(pattern(light, HasHost, 0), "###############.");
    EXPECT_EQ(pattern(light, LostTicks, 0), "##..##..##..##..");
    EXPECT_EQ(pattern(light, LostTicks, 0U - 16 * kSlot_us), "##..##..##..##..");
}

/// The time wraps meanwhile.
TEST(BoardLight, FlashesFourTimesASecondForTenSecondsIfItIsAsked) {
    BoardLight light;
    constexpr std::uint32_t kBegin = 0U - 16 * kSlot_us;
    light.identify(kBegin);
    EXPECT_EQ(pattern(light, LostTicks, kBegin), "#.#.#.#.........");
    EXPECT_EQ(pattern(light, HasHost, 0), "#.#.#.#.........");
    EXPECT_TRUE(light.is_on(HasHost, kBegin + BoardLight::kIdentify_us + kSlot_us));
    EXPECT_EQ(pattern(light, HasHost, kBegin), "###############.") << "it ended";
}

}  // namespace
}  // namespace lockstep::testing
