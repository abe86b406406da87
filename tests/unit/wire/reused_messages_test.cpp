// Messages that a loop sends and receives in each slot are translated without allocation, in reused memory.
#include <gtest/gtest.h>

#include "services/wire/translate/translate.hpp"
#include "tests/unit/allocations/counted_allocations.hpp"

namespace lockstep {
namespace {

Frame full_frame() {
    Frame frame{.number = 1, .ticks = {1}, .axes = std::vector<AxisTrack>(3)};
    for (AxisTrack& axis : frame.axes) {
        while (axis.body.size() < kMaxBodyPieces) { axis.body.append({{1}, {2}, {3}}); }
        while (axis.tail.size() < kMaxTailPieces) { axis.tail.append({{4}, {5}, {6}}); }
    }
    return frame;
}

MachineState running_state() {
    const LeaseHolder writer{7, "a writer with a rather long name", "a-host-with-a-rather-long-name"};
    MachineState state{.phase = MachinePhase::Running, .lease = HeldLease{writer, {5}}};
    state.pause = MachinePause{{PauseReason::ToolChange, 2, "a tool with a rather long name"}, {1, 2, 3}};
    for (FrameNumber frame = 1; frame <= 12; ++frame) { state.rests.append({.frame = frame}); }
    return state;
}

/// Translates a message there and back twice. The second time uses the memory of the first and allocates nothing.
template <typename Message>
void expect_reused(const Message& sent) {
    decltype(to_wire(sent)) wire{};
    Message received;
    const std::uint64_t before = CountedAllocations::count();
    for (const bool is_again : {false, true}) {
        const CountedAllocations counted(is_again);
        to_wire(sent, wire);
        ASSERT_TRUE(from_wire(wire, received));
    }
    EXPECT_EQ(CountedAllocations::count(), before) << CountedAllocations::places();
    EXPECT_EQ(received, sent);
}

TEST(ReusedMessages, OfAFrameAllocateNothing) { expect_reused(full_frame()); }
TEST(ReusedMessages, OfTheMachinesStateAllocateNothing) { expect_reused(running_state()); }
TEST(ReusedMessages, OfAnAxissStateAllocateNothing) { expect_reused(AxisState{.axis = 2, .stamp = 9}); }
TEST(ReusedMessages, OfAnOrderAllocateNothing) { expect_reused(AxisCommand{.sequence = 3, .axis = 1}); }

/// More frames than ever are in flight while an axis is stalled.
TEST(ReusedMessages, OfTheMachinesStateAllocateNothingForMoreRestsThanBefore) {
    MachineState sent = running_state();
    MachineStateMessage wire;
    MachineState received;
    to_wire(sent, wire);
    ASSERT_TRUE(from_wire(wire, received));
    MachineState copy = received;
    while (!sent.rests.full()) { sent.rests.append({.frame = sent.rests.size()}); }
    const std::uint64_t before = CountedAllocations::count();
    {
        const CountedAllocations counted;
        to_wire(sent, wire);
        ASSERT_TRUE(from_wire(wire, received));
        copy = received;
    }
    EXPECT_EQ(CountedAllocations::count(), before) << CountedAllocations::places();
    EXPECT_EQ(copy, sent);
}

/// A state that is refused changes nothing.
TEST(ReusedMessages, KeepTheirValueIfASampleIsRefused) {
    auto wire = to_wire(running_state());
    MachineState received = running_state();
    wire.progress = 2;
    EXPECT_FALSE(from_wire(wire, received));
    EXPECT_EQ(received, running_state());
}

}  // namespace
}  // namespace lockstep
