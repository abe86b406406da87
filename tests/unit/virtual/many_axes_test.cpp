// A machine with the greatest number of axes: every axis moves, and the loss of the last one stops all others.
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

MachineConfig full_machine() {
    MachineConfig machine = small_machine();
    machine.timing.slot_us = 10'000;
    machine.axes.resize(kMaxAxes, machine.axes[0]);
    for (std::size_t i = 0; i < kMaxAxes; ++i) { machine.axes[i].name = "A" + std::to_string(i); }
    return machine;
}

class FullMachine : public Rig {
protected:
    FullMachine() : Rig({.machine = MachineSetup{full_machine()}}) {}

    Program all_to(double mm) const {
        Program program{.name = "test", .axes = {}, .start_mm = std::vector<double>(kMaxAxes, 5)};
        for (const AxisConfig& axis : vm.machine().axes) { program.axes.push_back(axis.name); }
        program.blocks.push_back({.action = ProgramMove{std::vector<double>(kMaxAxes, mm), 0, true}});
        return program;
    }
};

TEST(AxisSets, HoldEveryAxisOfAMachineAndNoOther) {
    EXPECT_TRUE(AxisSet::first(0).empty());
    EXPECT_EQ(AxisSet::first(3).bits(), 0b111U);
    EXPECT_EQ(AxisSet::first(kMaxAxes).bits(), ~std::uint64_t{0});
    const AxisIndex last{kMaxAxes - 1};
    EXPECT_TRUE(AxisSet{last}.contains(last));
    EXPECT_FALSE(AxisSet{last}.contains(AxisIndex{0}));
}

TEST_F(FullMachine, MovesAllAxesTogetherAndStopsForTheLastOne) {
    home();
    EXPECT_EQ(vm.state()->motors_present, MotorSet::first(kMaxAxes));
    ASSERT_EQ(run(all_to(15)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_EQ(counts(), std::vector<std::int64_t>(kMaxAxes, 1500));

    ASSERT_EQ(ask(CommandKind::Home, {AxisIndex{kMaxAxes - 1}}).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_EQ(counts().back(), 500) << "only it is at its park position";
    EXPECT_EQ(counts().front(), 1500);

    Program back = all_to(90);
    back.start_mm.assign(kMaxAxes, 15);
    back.start_mm.back() = 5;
    ASSERT_EQ(run(back).status, ReplyStatus::Accepted);
    wait(0.6);
    const Ticks long_time{10'000'000};
    vm.schedule({.kind = VirtualFault::Kind::Crash, .process = kMaxAxes - 1, .at = vm.now(), .lasts = long_time});
    ASSERT_TRUE(reaches(MachinePhase::Fault, 10)) << describe();
    EXPECT_EQ(fault(), FaultCode::AxisLost);
    EXPECT_LT(counts().front(), 9000) << "no axis continues without it";
}

}  // namespace
}  // namespace lockstep
