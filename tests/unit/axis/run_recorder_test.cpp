// The record of a run: each body is recorded when the next one has begun, the last body with its tail.
#include "core/axis/state/run_recorder.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

constexpr Velocity kSpeed{std::int64_t{1} << 54};  // a step in 1024 ticks

HeldFrame frame(FrameNumber number) {
    HeldFrame frame{.number = number, .start = {static_cast<std::int64_t>(number) * 4096}, .ticks = {4096}};
    frame.track.from = Position::steps(4 * static_cast<std::int64_t>(number - 1));
    frame.track.body.append({{4096}, kSpeed, {0}});
    frame.track.tail.append({{1024}, kSpeed, {0}});
    return frame;
}

class Recorder : public testing::Test {
protected:
    Recorder() {
        for (FrameNumber k = 1; k <= 3; ++k) { frames.push_back(frame(k)); }
    }
    const ReusedVector<ExecutedTrack>& record(const DeviceStatus& device) {
        tracks.clear();
        recorder.take(device, {.epoch = 9, .zero_count = 100}, frames, tracks);
        return tracks;
    }
    HeldFrames frames{2};
    RunRecorder recorder;
    ReusedVector<ExecutedTrack> tracks;
};

TEST_F(Recorder, RecordsABodyWhenTheNextHasBegun) {
    EXPECT_TRUE(record({.frame = 1}).empty());
    ASSERT_EQ(record({.frame = 3}).size(), 2u);
    EXPECT_EQ(tracks[0].frame, 1u);
    EXPECT_EQ(tracks[1].stop_count, 8);
    EXPECT_EQ(tracks[1].epoch, 9u);
    EXPECT_EQ(frames.front().number, 3u) << "recorded frames are no longer held";
    EXPECT_TRUE(record({.frame = 3}).empty());
}

TEST_F(Recorder, RecordsTheTailThatEndedTheRun) {
    ASSERT_EQ(record({.frame = 2, .finished = true, .in_tail = true}).size(), 3u);
    EXPECT_TRUE(tracks[2].tail);
    EXPECT_EQ(tracks[2].start, frame(2).end());
    EXPECT_EQ(tracks[2].stop_count, 9);
    EXPECT_FALSE(tracks[2].cut);
}

TEST_F(Recorder, RecordsWhereASwitchCutTheBody) {
    ASSERT_EQ(record({.position = Position::steps(106), .frame = 2, .finished = true, .stopped_by_limit = true}).size(),
              2u);
    EXPECT_TRUE(tracks[1].cut);
    EXPECT_EQ(tracks[1].stop_count, 6);
}

}  // namespace
}  // namespace lockstep
