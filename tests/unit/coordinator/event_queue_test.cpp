// The events of a leg wait until the motion comes to their places, also if it goes back to an earlier place.
#include "core/coordinator/path/event_queue.hpp"

#include <gtest/gtest.h>

#include <initializer_list>

namespace lockstep {
namespace {

using Lines = std::vector<std::optional<std::int32_t>>;

class EventsOfALeg : public testing::Test {
protected:
    /// Adds events before the moves of blocks 2 and 5.
    EventsOfALeg() {
        queue.add({.block = 1, .line = 11});
        queue.add({.block = 4, .line = 14});
    }
    /// The lines of the events that are due in a frame in which the moves of these blocks begin.
    Lines due(std::initializer_list<std::uint32_t> blocks, bool is_last = false) {
        std::vector<MoveBegin> begins;
        for (const std::uint32_t block : blocks) { begins.push_back({block, 10}); }
        PathFrame frame;
        frame.ticks = Ticks{100};
        frame.last = is_last;
        std::vector<FrameEvent> events;
        queue.take_due(frame, begins, events);
        Lines lines;
        for (const FrameEvent& event : events) { lines.push_back(event.event.line); }
        return lines;
    }
    EventQueue queue;
};

TEST_F(EventsOfALeg, AreDueOnceWhereTheMoveBehindThemBegins) {
    EXPECT_EQ(due({0}), Lines{});
    EXPECT_EQ(due({2}), Lines{11});
    EXPECT_EQ(due({3}), Lines{});
    EXPECT_EQ(due({}, true), Lines{14}) << "at the end of the leg";
}

TEST_F(EventsOfALeg, AreDueAgainWhereTheFramesThatCameToThemWereNotRun) {
    EXPECT_EQ(due({2, 5}), (Lines{11, 14}));
    queue.resume(3);
    EXPECT_EQ(due({5}), Lines{14}) << "only the first one had happened";
    queue.resume(0);
    EXPECT_EQ(due({2, 5}), (Lines{11, 14}));
}

TEST_F(EventsOfALeg, AreKeptAsLongAsTheMotionMayRestBeforeThem) {
    EXPECT_EQ(due({2, 5}), (Lines{11, 14}));
    queue.forget_before(4);
    ASSERT_EQ(queue.before(5).size(), 1u) << "the event of block 4 is not before block 4";
    EXPECT_EQ(queue.before(5)[0].line, 14);
    queue.resume(4);
    EXPECT_EQ(due({5}), Lines{14});
}

TEST_F(EventsOfALeg, ThatWereNotDueYetAreNotForgotten) {
    queue.forget_before(3);
    EXPECT_EQ(due({2}), Lines{11});
}

}  // namespace
}  // namespace lockstep
