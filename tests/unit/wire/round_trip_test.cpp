// Core's messages arrive unchanged, for every type.
#include <gtest/gtest.h>

#include "services/wire/translate/translate.hpp"
#include "tests/unit/wire/random_messages.hpp"

namespace lockstep {
namespace {

template <typename Message>
void expect_round_trips(Message (RandomMessages::*make)()) {
    RandomMessages random(1);
    for (int i = 0; i < 300; ++i) {
        const Message sent = (random.*make)();
        const auto message = to_wire(sent);
        const auto received = from_wire(message);
        ASSERT_TRUE(received) << received.error() << ", message " << i;
        ASSERT_EQ(sent, *received) << "message " << i;
    }
}

TEST(RoundTrip, AFrameArrivesAsItWasSent) { expect_round_trips(&RandomMessages::frame); }
TEST(RoundTrip, AnAxisStateArrivesAsItWasSent) { expect_round_trips(&RandomMessages::axis_state); }
TEST(RoundTrip, AnAxisHealthArrivesAsItWasSent) { expect_round_trips(&RandomMessages::axis_health); }
TEST(RoundTrip, AnAxisCommandArrivesAsItWasSent) { expect_round_trips(&RandomMessages::axis_command); }
TEST(RoundTrip, AClockRequestArrivesAsItWasSent) { expect_round_trips(&RandomMessages::clock_request); }
TEST(RoundTrip, AClockReplyArrivesAsItWasSent) { expect_round_trips(&RandomMessages::clock_reply); }
TEST(RoundTrip, AMachineStateArrivesAsItWasSent) { expect_round_trips(&RandomMessages::machine_state); }
TEST(RoundTrip, ACommandArrivesAsItWasSent) { expect_round_trips(&RandomMessages::command); }
TEST(RoundTrip, AProgramChunkArrivesAsItWasSent) { expect_round_trips(&RandomMessages::chunk); }
TEST(RoundTrip, AReplyArrivesAsItWasSent) { expect_round_trips(&RandomMessages::reply); }
TEST(RoundTrip, AnEventArrivesAsItWasSent) { expect_round_trips(&RandomMessages::event); }
TEST(RoundTrip, MachineValuesArriveAsTheyWereSent) { expect_round_trips(&RandomMessages::machine_values); }

TEST(RoundTrip, TheLargestFrameFits) {
    Frame frame{.number = 1, .ticks = {1}, .axes = std::vector<AxisTrack>(kMaxAxes)};
    for (AxisTrack& axis : frame.axes) {
        while (axis.body.size() < kMaxBodyPieces) { (void)axis.body.push_back({{1}, {2}, {3}}); }
        while (axis.tail.size() < kMaxTailPieces) { (void)axis.tail.push_back({{4}, {5}, {6}}); }
    }
    const auto message = to_wire(frame);
    EXPECT_EQ(from_wire(message), frame);
}

TEST(RoundTrip, ALongReplyIsCutBetweenTwoCharacters) {
    std::string text;
    while (text.size() < 2000) { text += "€"; }  // three bytes each
    const auto even = from_wire(to_wire(Reply{.text = text}));
    const auto odd = from_wire(to_wire(Reply{.text = "x" + text}));
    ASSERT_TRUE(even && odd);
    EXPECT_EQ(even->text, text.substr(0, 1017) + " ...");  // one more character would not fit into 1023 bytes
    EXPECT_EQ(odd->text, "x" + text.substr(0, 1017) + " ...");
}

}  // namespace
}  // namespace lockstep
