#include "services/runtime/clock_error.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

TEST(ClockError, MakesAClockFastAndSetsIt) {
    const auto error = parse_clock_error("offset=-2.5,ppm=100,step=0.5@10");
    ASSERT_TRUE(error) << error.error();
    const nanoseconds now = seconds{1000};
    EXPECT_EQ(error->applied(now, seconds{0}), now - milliseconds{2500});
    EXPECT_EQ(error->applied(now, seconds{9}), now - milliseconds{2500} + nanoseconds{900'000});
    EXPECT_EQ(error->applied(now, seconds{10}), now - milliseconds{2000} + nanoseconds{1'000'000});
}

TEST(ClockError, AnEmptyTextIsNoError) {
    EXPECT_EQ(parse_clock_error(""), ClockError{});
    EXPECT_EQ(ClockError{}.applied(seconds{5}, seconds{3}), seconds{5});
}

TEST(ClockError, RefusesAnUnreadableTextAndNamesIt) {
    for (const char* text :
         {"offset", "offset=", "offset=x", "drift=5", "step=1", "step=1@-1", "ppm=1e99", "ppm=nan"}) {
        const auto error = parse_clock_error(std::string("ppm=5,") + text);
        ASSERT_FALSE(error) << text;
        EXPECT_NE(error.error().find(text), std::string::npos) << error.error();
    }
}

}  // namespace
}  // namespace lockstep
