// A whole machine in virtual time: what its axes order is executed by devices in Verilog too, which must make every
// step in the same tick.
#include <gtest/gtest.h>

#include <deque>
#include <vector>

#include "tests/rtl/machine/shadow.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep::rtl {
namespace {

/// With ticks of 20 us, so that a second is not many of them.
VirtualOptions slow_ticks() {
    VirtualOptions options{.machine = small_machine()};
    options.machine.tick_ns = 20'000;
    return options;
}

class HardwareMachine : public Rig {
protected:
    HardwareMachine() : Rig(slow_ticks()) {
        vm.observe(log_);
        for (const std::size_t axis : {kX, kY}) {
            shadows_.emplace_back(vm.registers(axis), vm.device(axis).plant(), vm.device(axis).now());
        }
    }

    /// Runs the machine for so long, and its devices in Verilog.
    void follow(double seconds) {
        const Tick end = vm.now() + Ticks{static_cast<std::int64_t>(seconds * vm.machine().ticks_per_second())};
        while (vm.now() < end) {
            vm.advance();
            for (const std::size_t axis : {kX, kY}) { shadows_[axis].follow(vm.device(axis).now()); }
        }
    }
    std::vector<StepEdge> steps_of(std::size_t axis) const {
        std::vector<StepEdge> steps;
        for (const StepLog::Step& step : log_.steps) {
            if (step.axis != axis) { continue; }
            steps.push_back({Tick{step.tick}, static_cast<std::int8_t>(step.direction)});
        }
        return steps;
    }
    void compare() {
        for (const std::size_t axis : {kX, kY}) {
            const RegisterWindow& simulated = vm.registers(axis);
            EXPECT_EQ(shadows_[axis].steps(), steps_of(axis)) << "axis " << axis;
            for (const std::size_t word : {registers::kStatus, registers::kCount, registers::kPhase, registers::kRun,
                                           registers::kFrame, registers::kCaptureSum, registers::kCaptureSums}) {
                EXPECT_EQ(shadows_[axis].load(word), simulated.load(word)) << "axis " << axis << ", word " << word;
            }
        }
    }

    StepLog log_;
    std::deque<Shadow> shadows_;
};

TEST_F(HardwareMachine, MakesEveryStepOfHomingAProgramAndAStopInTheTickOfTheSimulatedMachine) {
    follow(1);
    vm.command(CommandKind::Home);
    follow(12);
    ASSERT_EQ(vm.state()->phase, MachinePhase::Idle) << describe();
    compare();
    vm.give_program(7, program_of({{20, 10}, {10, 30}, {40, 40}}, 20));
    vm.command(CommandKind::Run, 0, 7);
    follow(2);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Running) << describe();
    vm.command(CommandKind::Stop);
    follow(1);
    compare();
    EXPECT_GT(shadows_[kX].steps().size(), 2'000);
}

}  // namespace
}  // namespace lockstep::rtl
