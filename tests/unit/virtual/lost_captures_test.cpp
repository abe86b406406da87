// A device makes more steps than its capture ring holds while its process stalls. The axis is in fault. The record has
// all steps with recorded times, and a jump for the others.
#include <gmock/gmock.h>

#include "clients/simulation/machine_recorder.hpp"
#include "services/record/record_sink.hpp"
#include "services/wire/lcm/lcm_decode.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

/// 400,000 steps/s, with frames so long that a stalled process leaves its device with more steps to make than fit.
MachineConfig fast_machine() {
    MachineConfig machine = small_machine();
    machine.timing = {};
    for (AxisConfig& axis : machine.axes) { axis.steps_per_mm = 4000; }
    return machine;
}

class Record : public RecordSink {
public:
    void write(const std::string& channel, std::int64_t, std::span<const std::uint8_t> bytes) override {
        if (channel == "LOCKSTEP_RIG_X_STEPS") { batches.push_back(decode_lcm<step_batch_t>(bytes).value()); }
        if (channel == "LOCKSTEP_RIG_X_POSITION") {
            faults.push_back(decode_lcm<axis_position_t>(bytes).value().fault);
        }
    }
    /// The first jump of the count from message `from` on, or 0 if there is none.
    std::int64_t first_jump(std::size_t from) const {
        for (std::size_t i = from + 1; i < batches.size(); ++i) {
            std::int64_t end = batches[i - 1].position_before;
            for (const std::int8_t direction : batches[i - 1].direction) { end += direction; }
            if (batches[i].position_before != end) { return batches[i].position_before - end; }
        }
        return 0;
    }
    std::vector<step_batch_t> batches;
    std::vector<std::int32_t> faults;
};

class LostCaptures : public Rig, public VirtualObserver {
protected:
    LostCaptures() : Rig({.machine = MachineSetup{fast_machine()}}) { vm.observe(*this); }
    void on_axis(MotorIndex axis, Tick, const AxisOutputs&, AxisNode& node) override {
        if (axis == 0) { lost = static_cast<std::int64_t>(node.device().lost_captures()); }
    }

    Record record;
    MachineRecorder recorder{vm, record};
    std::int64_t lost = 0;
};

TEST_F(LostCaptures, AreAFaultOfTheAxisAndAJumpInTheRecord) {
    home();
    const std::size_t before = record.batches.size();
    vm.give_program(100, program_of({{95, 5}}, 0));
    ASSERT_EQ(ask(CommandKind::MoveOwn, {}, 100).status, ReplyStatus::Accepted);
    wait(0.5);
    vm.schedule({.kind = VirtualFault::Kind::Freeze, .process = 0, .at = vm.now(), .lasts = Ticks{2'000'000}});
    wait(3);
    EXPECT_EQ(axis_fault(0), FaultCode::DeviceFault) << describe();
    EXPECT_GT(lost, 0);
    EXPECT_THAT(record.faults, testing::Contains(static_cast<std::int32_t>(FaultCode::DeviceFault)));

    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    home();
    recorder.finish();
    EXPECT_EQ(record.first_jump(before), lost) << "as many steps as have no time";
    for (std::size_t i = 0; i < record.batches.size(); ++i) {
        EXPECT_EQ(record.batches[i].sequence, static_cast<std::int64_t>(i)) << "no message is missing";
    }
}

}  // namespace
}  // namespace lockstep
