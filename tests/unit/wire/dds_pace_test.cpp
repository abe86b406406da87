// How often processes announce themselves, as deploy/scale.md states it.
#include "services/wire/dds/dds_pace.hpp"

#include <gmock/gmock.h>

namespace lockstep {
namespace {

using testing::StartsWith;

TEST(DdsPace, FewProcessesAnnounceThemselvesFiveTimesASecond) {
    EXPECT_THAT(discovery_pace(2), StartsWith("<SPDPInterval>200 ms<"));
    EXPECT_THAT(discovery_pace(16), StartsWith("<SPDPInterval>200 ms<"));
}

TEST(DdsPace, ThirtyThreeProcessesAnnounceThemselvesEvery850Milliseconds) {
    EXPECT_THAT(discovery_pace(33), StartsWith("<SPDPInterval>850 ms<"));
}

}  // namespace
}  // namespace lockstep
