// When the wait for an input ends.
#include "core/coordinator/jobs/input_watch.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

using enum InputWatch::Result;

InputWatch watch(InputMode mode) { return {mode, 10, Tick{1000}}; }

TEST(InputWatch, ForALevelEndsAtTheFirstKnownLevelThatIsWanted) {
    EXPECT_EQ(watch(InputMode::IsClosed).look(true, Tick{}), IsMet);
    EXPECT_EQ(watch(InputMode::IsClosed).look(false, Tick{}), Waits);
    EXPECT_EQ(watch(InputMode::IsOpen).look(false, Tick{}), IsMet);
    EXPECT_EQ(watch(InputMode::IsOpen).look(true, Tick{}), Waits);
    EXPECT_EQ(watch(InputMode::IsOpen).look(std::nullopt, Tick{}), Waits) << "unknown is not open";
}

TEST(InputWatch, ForAnEdgeNeedsBothLevels) {
    InputWatch closes = watch(InputMode::Closes);
    EXPECT_EQ(closes.look(true, Tick{1}), Waits);
    EXPECT_EQ(closes.look(false, Tick{2}), Waits);
    EXPECT_EQ(closes.look(std::nullopt, Tick{3}), Waits);
    EXPECT_EQ(closes.look(true, Tick{4}), IsMet);
    InputWatch opens = watch(InputMode::Opens);
    EXPECT_EQ(opens.look(false, Tick{1}), Waits);
    EXPECT_EQ(opens.look(true, Tick{2}), Waits);
    EXPECT_EQ(opens.look(false, Tick{3}), IsMet);
}

TEST(InputWatch, TimesOutAtItsLimitUnlessTheInputIsAsWantedThen) {
    EXPECT_EQ(watch(InputMode::IsClosed).look(false, Tick{999}), Waits);
    EXPECT_EQ(watch(InputMode::IsClosed).look(false, Tick{1000}), TimedOut);
    EXPECT_EQ(watch(InputMode::IsClosed).look(std::nullopt, Tick{1000}), TimedOut);
    EXPECT_EQ(watch(InputMode::IsClosed).look(true, Tick{1000}), IsMet);
}

}  // namespace
}  // namespace lockstep
