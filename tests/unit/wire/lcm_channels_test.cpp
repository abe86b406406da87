#include "services/wire/lcm/lcm_channels.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

TEST(LcmChannels, AreUpperCasedAndFreeOfRegularExpressions) {
    EXPECT_EQ(channels_of("mill-2", "x.a").steps, "LOCKSTEP_MILL_2_X_A_STEPS");
    EXPECT_EQ(channels_of("Mill", "Z").position, "LOCKSTEP_MILL_Z_POSITION");
    EXPECT_EQ(channels_of("Mill", "Z").run, "LOCKSTEP_MILL_Z_RUN");
    EXPECT_EQ(channels_of("Mill", "Z").health, "LOCKSTEP_MILL_Z_HEALTH");
    EXPECT_EQ(channels_of("Mill", "Z").channels, "LOCKSTEP_MILL_Z_CHANNELS");
    EXPECT_EQ(kind_of("LOCKSTEP_MILL_Z_CHANNELS"), RecordKind::Channels);
    EXPECT_EQ(job_channel("Mill"), "LOCKSTEP_MILL_JOB");
    EXPECT_EQ(event_channel("Mill"), "LOCKSTEP_MILL_EVENTS");
}

TEST(LcmChannels, EventsAreNumberedWithJobs) {
    EXPECT_EQ(kind_of(event_channel("Mill")), RecordKind::Event);
    EXPECT_EQ(numbered_with(RecordKind::Event), RecordKind::Job);
    EXPECT_EQ(numbered_with(RecordKind::Run), RecordKind::Run);
}

}  // namespace
}  // namespace lockstep
