#include "services/virtual/virtual_machine.hpp"

#include <gtest/gtest.h>

#include "core/protocol/names.hpp"
#include "services/documents/machine_file.hpp"
#include "services/documents/program_file.hpp"

namespace lockstep {
namespace {

std::string describe(const VirtualMachine& vm) {
    std::string text = "phase " + std::to_string(static_cast<int>(vm.state()->phase)) + " fault " +
                       std::string(name_of(vm.state()->fault));
    for (const auto& axis : vm.axis_states()) {
        if (axis) { text += " | " + std::string(name_of(axis->phase)) + " " + std::string(name_of(axis->fault)); }
    }
    return text;
}

class TwoAxes : public testing::Test {
protected:
    TwoAxes() : vm({.machine = MachineSetup{*load_machine_file("deploy/examples/three-axis.textproto")}}) {}

    bool reaches(MachinePhase phase, double seconds) {
        const Ticks limit{static_cast<std::int64_t>(seconds * vm.machine().ticks_per_second())};
        return vm.advance_until([&] { return vm.state() && vm.state()->phase == phase; }, limit);
    }
    void home() {
        ASSERT_TRUE(reaches(MachinePhase::Idle, 2)) << describe(vm);
        vm.command(CommandKind::Home);
        ASSERT_TRUE(reaches(MachinePhase::Homing, 1)) << describe(vm);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 60)) << describe(vm);
    }
    std::vector<double> positions() const {
        std::vector<double> mm;
        for (std::size_t i = 0; i < vm.axis_states().size(); ++i) {
            mm.push_back(to_mm(vm.machine().axes[i], static_cast<double>(vm.axis_states()[i]->position.count())));
        }
        return mm;
    }

    VirtualMachine vm;
};

TEST_F(TwoAxes, HomeThenStandParked) {
    home();
    for (std::size_t i = 0; i < positions().size(); ++i) {
        EXPECT_DOUBLE_EQ(positions()[i], vm.machine().axes[i].homing.park_mm);
        EXPECT_TRUE(vm.axis_states()[i]->homed);
    }
}

TEST_F(TwoAxes, RunAFileToItsEnd) {
    home();
    auto program = load_gcode_file("deploy/examples/plate.gcode", vm.machine(), positions());
    ASSERT_TRUE(program.has_value());
    vm.give_program(1, *program);
    const auto sequence = vm.command(CommandKind::Run, {}, 1);
    ASSERT_TRUE(vm.advance_until([&] { return vm.reply_to(sequence) != nullptr; }, Ticks{1'000'000}));
    ASSERT_EQ(vm.reply_to(sequence)->status, ReplyStatus::Accepted) << vm.reply_to(sequence)->text;
    ASSERT_TRUE(reaches(MachinePhase::Running, 2)) << describe(vm);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 200)) << describe(vm);
}

}  // namespace
}  // namespace lockstep
