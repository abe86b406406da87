// Changes of inputs and outputs that a record lacks are found with the times between which they were published.
#include "clients/merge/channel_gaps.hpp"

#include <gtest/gtest.h>

namespace lockstep::merge {
namespace {

TEST(ChannelGaps, HaveTheTimesOfTheChangesAroundThem) {
    ChannelGaps channels;
    for (const std::int64_t number : {2, 3, 6}) { channels.take(number, 1000 * number, 0); }
    const auto gaps = channels.gaps();
    ASSERT_EQ(gaps.size(), 2U);
    EXPECT_EQ(gaps[0].messages, 2);
    EXPECT_FALSE(gaps[0].from_us) << "the first changes";
    EXPECT_EQ(gaps[0].to_us, 2000);
    EXPECT_EQ(gaps[1].messages, 2);
    EXPECT_EQ(gaps[1].from_us, 3000);
    EXPECT_EQ(gaps[1].to_us, 6000);
}

TEST(ChannelGaps, AreFilledByChangesInAnyOrder) {
    ChannelGaps channels;
    for (const std::int64_t number : {0, 4, 2, 1, 5, 3}) { channels.take(number, 1000 * number, 0); }
    EXPECT_TRUE(channels.gaps().empty());
    channels.take(7, 7000, 0);
    ASSERT_EQ(channels.gaps().size(), 1U);
    EXPECT_EQ(channels.gaps()[0].from_us, 5000);
}

TEST(ChannelGaps, CountWhatTheDeviceLostSinceTheFirstMessage) {
    ChannelGaps channels;
    EXPECT_EQ(channels.lost_by_device(), 0);
    channels.take(0, 1000, 4);
    EXPECT_EQ(channels.lost_by_device(), 0) << "lost before the process began";
    channels.take(1, 2000, 4);
    channels.take(2, 3000, 7);
    EXPECT_EQ(channels.lost_by_device(), 3);
}

}  // namespace
}  // namespace lockstep::merge
