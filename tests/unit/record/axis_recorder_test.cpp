// The record counts from where the device stands, also where the device has outlived the process before.
#include "services/record/axis_recorder.hpp"

#include <gtest/gtest.h>

#include "services/wire/lcm/lcm_decode.hpp"

namespace lockstep {
namespace {

class Batches : public RecordSink {
public:
    void write(const std::string& channel, std::int64_t, std::span<const std::uint8_t> bytes) override {
        if (channel.ends_with("_STEPS")) { batches.push_back(decode_lcm<step_batch_t>(bytes).value()); }
    }
    std::vector<step_batch_t> batches;
};

AxisOutputs says(std::int64_t position_steps, std::int64_t tick) {
    AxisOutputs out;
    out.state = AxisState{.position = Position::steps(position_steps), .tick = Tick{tick}};
    return out;
}

class TheRecord : public testing::Test {
protected:
    MachineConfig machine{.name = "mill", .axes = {{.name = "X", .steps_per_mm = 80}}};
    Batches sink;
    AxisRecorder recorder{machine, 0, 7, sink};
};

TEST_F(TheRecord, BeginsAtZeroWithADeviceJustPoweredUp) {
    recorder.loop(says(0, 100), 0, 0);
    recorder.step({Tick{200}, +1});
    recorder.finish();
    ASSERT_EQ(sink.batches.size(), 1U);
    EXPECT_EQ(sink.batches[0].position_before, 0);
}

TEST_F(TheRecord, BeginsWhereADeviceStandsThatRanBefore) {
    recorder.loop(says(400, 100), 0, 0);
    recorder.step({Tick{200}, -1});
    recorder.finish();
    ASSERT_EQ(sink.batches.size(), 1U);
    EXPECT_EQ(sink.batches[0].position_before, 400);
}

TEST_F(TheRecord, BeginsInMachineCoordinatesWithAnAxisThatIsHomedFromTheStart) {
    recorder.loop(says(400, 100), -3920, 0);
    recorder.step({Tick{200}, +1});
    recorder.finish();
    ASSERT_EQ(sink.batches.size(), 1U);
    EXPECT_EQ(sink.batches[0].position_before, 400);
}

TEST_F(TheRecord, CountsTheStepsThatWereLeftForItAndThoseMadeMeanwhile) {
    recorder.step({Tick{80}, +1});
    recorder.step({Tick{90}, +1});
    recorder.step({Tick{101}, +1});  // after the look at the device
    recorder.loop(says(400, 100), 0, 0);
    recorder.finish();
    ASSERT_EQ(sink.batches.size(), 1U);
    EXPECT_EQ(sink.batches[0].position_before, 398);
    EXPECT_EQ(sink.batches[0].count, 3);
}

TEST_F(TheRecord, JumpsWhereTheAxisIsZeroed) {
    recorder.loop(says(0, 100), 0, 0);
    recorder.step({Tick{200}, -1});
    recorder.loop({}, -81, 0);
    recorder.step({Tick{400}, +1});
    recorder.finish();
    ASSERT_EQ(sink.batches.size(), 2U);
    EXPECT_EQ(sink.batches[1].position_before, 80);
}

TEST_F(TheRecord, SaysWhereStepsLackTheirTimes) {
    recorder.loop(says(0, 100), 0, 0);
    recorder.step({Tick{200}, +1});
    recorder.loop(says(1, 210), 0, 3);  // three more were made, and their times not kept
    recorder.step({Tick{400}, +1});
    recorder.loop(says(5, 410), 0, 3);
    recorder.finish();
    ASSERT_EQ(sink.batches.size(), 2U);
    EXPECT_EQ(sink.batches[0].position_before + sink.batches[0].count, 1);
    EXPECT_EQ(sink.batches[1].position_before, 4) << "not 1: a reader sees that the count jumps";
    EXPECT_EQ(sink.batches[1].sequence, 1) << "no message is missing";
}

}  // namespace
}  // namespace lockstep
