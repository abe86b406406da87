// The parts of an epoch: the frames made, those in flight with their vetoes, and the events that are due.
#include <gmock/gmock.h>

#include "core/coordinator/epoch/due_events.hpp"
#include "core/coordinator/epoch/frames_in_flight.hpp"
#include "core/coordinator/epoch/made_frames.hpp"

namespace lockstep {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr Slot kFirst = 100;  // the slot in which the first frame starts
constexpr Ticks kSlot{1000};
constexpr Ticks kFrame{5000};
constexpr Piece kPiece{.ticks = kFrame, .velocity = Velocity{1'000'000}, .acceleration = {}};

/// The frame moves one axis by kPiece in its body, and by as much in its tail.
Frame frame(FrameNumber number) {
    Frame made{.number = number, .start = rules::start_of(kFirst, kSlot), .ticks = kFrame};
    made.start += kFrame * static_cast<std::int64_t>(number - 1);
    made.axes.resize(1);
    made.axes[0].body = {kPiece};
    made.axes[0].tail = {kPiece};
    return made;
}

/// Frame n begins in block 10 n, and rests in the block behind that.
PathFrame path(FrameNumber number) {
    const auto block = static_cast<std::uint32_t>(10 * number);
    PathFrame made{.ticks = kFrame, .begin = {block, {}}, .rest = {block + 1, {}}, .places = {}};
    made.places.fill(made.begin);
    return made;
}

MadeFrames made(FrameNumber count) {
    MadeFrames frames;
    frames.begin({3, {}}, {Position{}});
    frames.start_at(frame(1).start);
    for (FrameNumber k = 1; k <= count; ++k) { frames.add(frame(k), path(k), false); }
    return frames;
}

TEST(MadeFrames, BeforeTheFirstOneTheMachineRestsWhereTheEpochBegins) {
    const EpochEnd end = made(0).end_behind(0);
    EXPECT_EQ(end.place.block, 3u);
    EXPECT_EQ(end.positions[0], Position{});
    EXPECT_EQ(made(0).place_at(Tick{}).block, 3u);
}

TEST(MadeFrames, KnowWhereEachFrameLeadsAndRests) {
    const MadeFrames frames = made(3);
    EXPECT_EQ(frames.newest(), 3u);
    EXPECT_EQ(frames.next_start(), frame(4).start);
    EXPECT_EQ(frames.rests(), frame(4).start + kFrame) << "behind the tail";
    EXPECT_EQ(frames.place_at(frame(2).start + Ticks{1}).block, 20u);
    EXPECT_EQ(frames.place_at(frame(9).start).block, 31u);
    const EpochEnd end = frames.end_behind(2);
    EXPECT_EQ(end.kind, EpochEnd::Kind::Interrupted);
    EXPECT_EQ(end.place.block, 21u);
    const Displacement one = kPiece.covered();
    EXPECT_EQ(end.positions[0], Position{} + one + one + one);
}

TEST(MadeFrames, OnlyTheNewestAreKept) {
    const MadeFrames frames = made(kMaxRests + 3);
    EXPECT_FALSE(frames.keeps(3));
    EXPECT_TRUE(frames.keeps(4));
    EXPECT_FALSE(frames.keeps(kMaxRests + 4));
    EXPECT_EQ(frames.ticks_of(3), Ticks{});
    EXPECT_EQ(frames.ticks_of(4), kFrame * 4);
    StaticVector<FrameRest, kMaxRests> rests;
    frames.list_rests(0, rests);
    EXPECT_EQ(rests.size(), kMaxRests);
    frames.list_rests(kMaxRests + 2, rests);
    EXPECT_EQ(rests.size(), 2u);
}

class InFlight : public testing::Test {
protected:
    static constexpr ProtocolTiming kTiming{.slot_us = 1000,
                                            .stall_slots = 1,
                                            .late_check_slots = 0,
                                            .freshness_slots = 2,
                                            .send_ahead_slots = 12,
                                            .frame_slots = 5};
    InFlight() {
        for (FrameNumber k = 1; k <= 3; ++k) {
            flight.add([k](Frame&&) { return frame(k); });
        }
    }
    std::vector<FrameNumber> repeated(FrameNumber held, Slot now = kFirst - 12) {
        ReusedVector<Frame> frames;
        flight.repeat(now, held, frames);
        std::vector<FrameNumber> numbers;
        for (const Frame& frame : frames) { numbers.push_back(frame.number); }
        return numbers;
    }
    static AxisView says(FrameNumber held, std::optional<FrameNumber> veto, Epoch epoch = 1) {
        return {AxisState{.epoch = epoch, .held = held, .veto = veto}, kFirst};
    }

    FramesInFlight flight{kTiming, kSlot};
};

TEST_F(InFlight, FramesThatAnAxisLacksAreRepeatedWhileTheyAreInTime) {
    const std::vector<AxisView> axes{says(2, {}), says(1, {})};
    EXPECT_EQ(flight.receive(1, 3, axes), 1u);
    EXPECT_THAT(repeated(1), ElementsAre(2, 3));
    EXPECT_THAT(repeated(3), IsEmpty());
    EXPECT_THAT(repeated(0, kFirst), ElementsAre(3)) << "frame 1 has begun, and frame 2 would be late";
}

TEST_F(InFlight, AnAxisOfAnotherEpochHoldsNothingAndItsVetoDoesNotCount) {
    const std::vector<AxisView> axes{says(3, {}), says(3, 1, 7)};
    EXPECT_EQ(flight.receive(1, 3, axes), 0u);
    EXPECT_FALSE(flight.veto());
}

TEST_F(InFlight, NoFrameIsRepeatedBehindTheLowestVeto) {
    const std::vector<AxisView> axes{says(0, 3), says(0, 2)};
    (void)flight.receive(1, 3, axes);
    EXPECT_EQ(flight.veto(), 2u);
    EXPECT_THAT(repeated(0), ElementsAre(1));
}

TEST_F(InFlight, AStopVetoesTheLowestFrameThatNoAxisCanHaveArmed) {
    flight.stop(kFirst - 12, 3);
    EXPECT_EQ(flight.veto(), 1u);
    flight.clear();
    flight.stop(kFirst - 12, 0);
    EXPECT_EQ(flight.veto(), 1u) << "of an epoch without a frame";
}

TEST_F(InFlight, AStopThatIsTooLateForAllFramesVetoesTheNextOne) {
    flight.stop(kFirst + 10, 3);
    EXPECT_EQ(flight.veto(), 4u);
}

TEST(DueEvents, HappenOnceWhenTheirFrameHasBegunAndTheirTickHasPassed) {
    DueEvents due;
    due.add(frame(1), std::vector<FrameEvent>{{Ticks{10}, {.block = 1}}, {Ticks{20}, {.block = 2}}});
    due.add(frame(2), std::vector<FrameEvent>{{Ticks{0}, {.block = 3}}});
    const auto blocks = [&](Tick now, FrameNumber begun) {
        std::vector<std::uint32_t> taken;
        for (const DueEvents::Happened& event : due.take(now, begun)) { taken.push_back(event.event.block); }
        return taken;
    };
    const Tick start = frame(1).start;
    EXPECT_THAT(blocks(start + Ticks{10}, 0), IsEmpty()) << "no axis has begun the frame";
    EXPECT_THAT(blocks(start + Ticks{10}, 1), ElementsAre(1));
    EXPECT_THAT(blocks(start + kFrame, 1), ElementsAre(2));
    EXPECT_THAT(blocks(start + kFrame, 2), ElementsAre(3));
}

}  // namespace
}  // namespace lockstep
