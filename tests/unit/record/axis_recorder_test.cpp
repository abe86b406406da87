// The record counts from the device's position, even if the device has outlived the previous process.
#include "services/record/axis_recorder.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "services/wire/lcm/lcm_decode.hpp"
#include "tests/unit/allocations/counted_allocations.hpp"

namespace lockstep {
namespace {

class Batches : public RecordSink {
public:
    void write(const std::string& channel, std::int64_t, std::span<const std::uint8_t> bytes) override {
        if (channel.ends_with("_STEPS")) { batches.push_back(decode_lcm<step_batch_t>(bytes).value()); }
        if (channel.ends_with("_MARK")) { marks.push_back(decode_lcm<record_mark2_t>(bytes).value()); }
    }
    std::vector<step_batch_t> batches;
    std::vector<record_mark2_t> marks;
};

AxisOutputs outputs_at(std::int64_t position_steps, std::int64_t tick) {
    AxisOutputs out;
    out.state = AxisState{.position = Position::steps(position_steps), .tick = Tick{tick}};
    return out;
}

class TheRecord : public testing::Test {
protected:
    MachineConfig machine{.name = "mill", .axes = {{.name = "X", .steps_per_mm = 80}}};
    Batches sink;
    AxisRecorder recorder{machine, MotorIndex{0}, 7, sink};
};

class Sizes : public RecordSink {
public:
    void write(const std::string&, std::int64_t, std::span<const std::uint8_t> bytes) override {
        largest_bytes = std::max(largest_bytes, bytes.size());
    }
    std::size_t largest_bytes = 0;
};

TEST(RecordOfAStalledAxis, AllocatesNothingForTheLargestMessageOfSteps) {
    const MachineConfig machine{.name = "mill", .axes = {{.name = "X", .steps_per_mm = 80}}};
    Sizes sink;
    AxisRecorder recorder(machine, MotorIndex{0}, 7, sink);
    recorder.reserve(2 * StepBatcher::kMaxSteps, 0);
    recorder.loop(outputs_at(0, 100), 0, 0);
    const AxisOutputs out;
    const std::uint64_t before = CountedAllocations::count();
    {
        const CountedAllocations counted;
        for (std::int64_t i = 0; i <= StepBatcher::kMaxSteps; ++i) { recorder.step({Tick{200 + i}, +1}); }
        recorder.loop(out, 0, 0);
    }
    EXPECT_EQ(CountedAllocations::count(), before) << CountedAllocations::places();
    EXPECT_GT(sink.largest_bytes, 5U * StepBatcher::kMaxSteps);
}

TEST_F(TheRecord, BeginsAtZeroWithADeviceJustPoweredUp) {
    recorder.loop(outputs_at(0, 100), 0, 0);
    recorder.step({Tick{200}, +1});
    recorder.finish();
    ASSERT_EQ(sink.batches.size(), 1U);
    EXPECT_EQ(sink.batches[0].position_before, 0);
}

TEST_F(TheRecord, BeginsAtThePositionOfADeviceThatRanBefore) {
    recorder.loop(outputs_at(400, 100), 0, 0);
    recorder.step({Tick{200}, -1});
    recorder.finish();
    ASSERT_EQ(sink.batches.size(), 1U);
    EXPECT_EQ(sink.batches[0].position_before, 400);
}

TEST_F(TheRecord, BeginsInMachineCoordinatesWithAnAxisThatIsHomedFromTheStart) {
    recorder.loop(outputs_at(400, 100), -3920, 0);
    recorder.step({Tick{200}, +1});
    recorder.finish();
    ASSERT_EQ(sink.batches.size(), 1U);
    EXPECT_EQ(sink.batches[0].position_before, 400);
}

TEST_F(TheRecord, CountsChangesOfOutputsInItsMarksAndInItsLastOne) {
    recorder.channel({.tick = Tick{80}, .kind = ChannelEvent::Kind::Digital, .levels = 1});
    recorder.loop(outputs_at(0, 100), 0, 0);
    EXPECT_EQ(recorder.published().channel_events, 1U);
    recorder.channel({.tick = Tick{190}, .kind = ChannelEvent::Kind::Digital, .levels = 0});
    recorder.finish();
    ASSERT_FALSE(sink.marks.empty());
    EXPECT_EQ(sink.marks.back().channel_events, 2);
    EXPECT_EQ(sink.marks.back().ended, 1);
}

TEST_F(TheRecord, CountsTheStepsThatWereLeftForItAndThoseMadeMeanwhile) {
    recorder.step({Tick{80}, +1});
    recorder.step({Tick{90}, +1});
    recorder.step({Tick{101}, +1});  // after the device was read
    recorder.loop(outputs_at(400, 100), 0, 0);
    recorder.finish();
    ASSERT_EQ(sink.batches.size(), 1U);
    EXPECT_EQ(sink.batches[0].position_before, 398);
    EXPECT_EQ(sink.batches[0].count, 3);
}

TEST_F(TheRecord, JumpsWhereTheAxisIsZeroed) {
    recorder.loop(outputs_at(0, 100), 0, 0);
    recorder.step({Tick{200}, -1});
    recorder.loop({}, -81, 0);
    recorder.step({Tick{400}, +1});
    recorder.finish();
    ASSERT_EQ(sink.batches.size(), 2U);
    EXPECT_EQ(sink.batches[1].position_before, 80);
}

TEST_F(TheRecord, ShowsStepsWithoutTimes) {
    recorder.loop(outputs_at(0, 100), 0, 0);
    recorder.step({Tick{200}, +1});
    recorder.loop(outputs_at(1, 210), 0, 3);  // three more were made, without recorded times
    recorder.step({Tick{400}, +1});
    recorder.loop(outputs_at(5, 410), 0, 3);
    recorder.finish();
    ASSERT_EQ(sink.batches.size(), 2U);
    EXPECT_EQ(sink.batches[0].position_before + sink.batches[0].count, 1);
    EXPECT_EQ(sink.batches[1].position_before, 4) << "not 1: the jump of the count is visible";
    EXPECT_EQ(sink.batches[1].sequence, 1) << "no message is missing";
}

}  // namespace
}  // namespace lockstep
