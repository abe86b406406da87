// The states that a client has received: of motors, of axes by their motors, and how old they may be.
#include "clients/session/received/received_axes.hpp"

#include <gtest/gtest.h>

#include "clients/session/received/received_values.hpp"
#include "services/runtime/clock.hpp"
#include "tests/unit/session/two_axes.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

AxisState state_of(std::uint16_t axis) {
    AxisState state;
    state.axis = axis;
    return state;
}

TEST(ReceivedAxes, AnAxisIsPresentUntilItsSilenceIsTooLong) {
    ReceivedAxes received(two_axes());
    EXPECT_FALSE(received.axis_present(AxisIndex{0}));
    received.take(state_of(0), monotonic_now());
    EXPECT_TRUE(received.motor_present(MotorIndex{0}));
    EXPECT_TRUE(received.axis_present(AxisIndex{0}));
    EXPECT_FALSE(received.axis_present(AxisIndex{1}));
    EXPECT_EQ(received.names(), "X");
    received.take(state_of(1), monotonic_now() - longest_silence(two_axes()) - 1s);
    EXPECT_TRUE(received.axis(AxisIndex{1}));
    EXPECT_FALSE(received.axis_present(AxisIndex{1}));
    EXPECT_EQ(received.names(), "X");
}

TEST(ReceivedAxes, IgnoresMotorsThatTheMachineDoesNotHave) {
    ReceivedAxes received(two_axes());
    received.take(state_of(2), monotonic_now());
    received.take(AxisHealth{.axis = 2});
    EXPECT_EQ(received.names(), "");
}

TEST(ReceivedValues, AreUnsavedSinceTheFirstChangeThatIsNotOnTheDisk) {
    ReceivedValues values;
    EXPECT_FALSE(values.has_any());
    values.take({.revision = 1, .on_disk = true, .bytes = {}}, 1s);
    EXPECT_FALSE(values.unsaved_since());
    values.take({.revision = 2, .on_disk = false, .bytes = {}}, 2s);
    values.take({.revision = 3, .on_disk = false, .bytes = {}}, 3s);
    EXPECT_EQ(values.unsaved_since(), 2s);
    EXPECT_FALSE(values.is_kept(3));
    values.take({.revision = 3, .on_disk = true, .bytes = {}}, 4s);
    EXPECT_TRUE(values.is_kept(3));
    EXPECT_TRUE(values.is_kept(2));
    EXPECT_FALSE(values.is_kept(4));
    EXPECT_FALSE(values.unsaved_since());
}

TEST(ReceivedValues, IgnoresTheValuesOfAnOlderTerm) {
    ReceivedValues values;
    values.take({.term = {.number = 2}, .revision = 1, .on_disk = true, .bytes = {}}, 1s);
    values.take({.term = {.number = 1}, .revision = 9, .on_disk = true, .bytes = {}}, 2s);
    EXPECT_FALSE(values.is_kept(9));
}

}  // namespace
}  // namespace lockstep
