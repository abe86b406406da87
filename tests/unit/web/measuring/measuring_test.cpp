// The newest measurement of the server.
#include "clients/web/machine/measuring.hpp"

#include <gtest/gtest.h>

namespace lockstep::web {
namespace {

TEST(NewestMeasurement, EndsWhenAnotherProgramBegins) {
    Measuring measuring;
    measuring.note_begin(nullptr);
    EXPECT_FALSE(measuring.newest()) << "nothing was measured";
    const auto plan = std::make_shared<const MeasurePlan>();
    measuring.begin(plan);
    measuring.note_begin(plan.get());
    EXPECT_FALSE(measuring.newest()->problem) << "it is its own next part";
    measuring.note_begin(nullptr);
    ASSERT_TRUE(measuring.newest()->problem);
    EXPECT_EQ(measuring.newest()->problem->code, "ended-early");
    measuring.begin(plan);
    EXPECT_EQ(measuring.newest()->number, 2u);
    EXPECT_FALSE(measuring.newest()->problem);
}

}  // namespace
}  // namespace lockstep::web
