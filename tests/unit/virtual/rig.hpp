// A small machine in virtual time, and helpers for its tests.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/faults.hpp"
#include "services/setup/machine_setup.hpp"
#include "services/virtual/virtual_machine.hpp"
#include "tests/unit/axis/pair_machine.hpp"

namespace lockstep {

// The processes of the small machine.
inline constexpr std::size_t kX = 0;
inline constexpr std::size_t kY = 1;
inline constexpr std::size_t kCoordinator = 2;

/// Two axes, X and Y, 100 mm of travel, 100 steps/mm, with slides that start near the switches.
inline MachineSetup small_machine() {
    MachineSetup machine{pair_machine()};
    machine.name = "rig";
    for (AxisConfig& axis : machine.axes) {
        axis.position_min_mm = 0;
        axis.homing.switch_position_mm = -1;
        axis.plant = {
            .start_position_mm = 8, .travel_margin_mm = 2, .max_torque_accel_mm_s2 = 1500, .max_jump_mm_s = 15};
    }
    return machine;
}

inline Program program_of(const std::vector<std::vector<double>>& targets, double feed_mm_s,
                          std::vector<double> start = {5, 5}) {
    Program program{.name = "test", .axes = {"X", "Y"}, .start_mm = std::move(start)};
    for (const auto& target : targets) {
        program.blocks.push_back({.action = ProgramMove{target, feed_mm_s, feed_mm_s == 0}});
    }
    return program;
}

/// Every step with its axis, ticks relative to the first.
class StepLog : public VirtualObserver {
public:
    struct Step {
        std::size_t axis = 0;
        std::int64_t tick = 0;
        int direction = 0;
        bool operator==(const Step&) const = default;
    };
    void on_step(MotorIndex axis, StepEdge step) override { steps.push_back({axis, step.tick.value, step.direction}); }
    std::vector<Step> steps;
};

class Rig : public testing::Test {
protected:
    explicit Rig(const VirtualOptions& options = {.machine = small_machine()}) : vm(options) {}

    bool reaches(MachinePhase phase, double seconds) {
        const Ticks limit{static_cast<std::int64_t>(seconds * vm.machine().ticks_per_second())};
        return vm.advance_until([&] { return vm.state() && vm.state()->job >= job_ && vm.state()->phase == phase; },
                                limit);
    }
    void wait(double seconds) {
        (void)vm.advance_until([] { return false; }, Ticks{static_cast<std::int64_t>(seconds * 1e6)});
    }
    Reply ask(CommandKind kind, AxisSet axes = {}, std::uint64_t program = 0, std::optional<Ticks> ticks = {}) {
        const auto sequence = vm.command(kind, axes, program, ticks);
        const auto answered = [&] { return vm.reply_to(sequence) != nullptr; };
        for (int tries = 0; tries < 4 && !vm.advance_until(answered, Ticks{250'000}); ++tries) { vm.repeat_command(); }
        const Reply* reply = vm.reply_to(sequence);
        if (reply != nullptr) { job_ = std::max(job_, reply->job); }
        return reply == nullptr ? Reply{.status = ReplyStatus::Refused, .text = "no reply"} : *reply;
    }
    Reply run(const Program& program) {
        vm.give_program(++programs_, program);
        return ask(CommandKind::Run, {}, programs_);
    }
    void home() {
        ASSERT_TRUE(reaches(MachinePhase::Idle, 2)) << describe();
        ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 20)) << describe();
    }
    std::vector<std::int64_t> counts() const {
        std::vector<std::int64_t> counts;
        for (const auto& state : vm.axis_states()) { counts.push_back(state->position.count()); }
        return counts;
    }
    FaultCode fault() const { return vm.state()->fault; }
    FaultCode axis_fault(std::size_t i) const { return vm.axis_states()[i]->fault; }
    std::string describe() const {
        std::string text =
            "phase " + std::to_string(static_cast<int>(vm.state()->phase)) + ", " + std::string(name_of(fault()));
        for (std::size_t i = 0; i < vm.axis_states().size(); ++i) {
            text +=
                " | " + std::string(name_of(vm.axis_states()[i]->phase)) + ", " + std::string(name_of(axis_fault(i)));
        }
        return text;
    }

    VirtualMachine vm;

private:
    std::uint64_t job_ = 0;  // queries of the state's phase refer to this job or a later one
    std::uint64_t programs_ = 0;
};

}  // namespace lockstep
