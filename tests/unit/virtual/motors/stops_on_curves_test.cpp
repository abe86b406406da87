// A hold begins to brake at once at every place of a path, also where motors follow curves.
#include <cmath>

#include "tests/unit/virtual/motors/delta_machine.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

MachineConfig mill() { return small_machine(); }
MachineConfig mill_with_a_screw() {
    MachineConfig machine = small_machine();
    machine.axes[kX].screw = {
        {.position_mm = 0, .error_mm = 0}, {.position_mm = 50, .error_mm = 0.05}, {.position_mm = 100, .error_mm = 0}};
    return machine;
}

struct CurvedMove {
    const char* name;
    MachineConfig (*machine)();
    std::vector<double> to_mm;
    std::optional<ArcShape> arc;
};

struct SlowMove {
    CurvedMove move;
    double feed_mm_min = 0;
};

const CurvedMove kArc{
    "Arc",
    mill,
    {25, 5},
    ArcShape{.first = 0, .second = 1, .centre_first_mm = 15, .centre_second_mm = 5, .is_clockwise = true}};
const CurvedMove kScrew{"Screw", mill_with_a_screw, {95, 5}, {}};
const CurvedMove kDelta{"Delta", delta_machine, {50, 0, 80}, {}};

class HoldOnACurve : public Rig, public testing::WithParamInterface<SlowMove> {
protected:
    HoldOnACurve() : Rig({.machine = MachineSetup{machine()}}) {}

    static MachineConfig machine() {
        MachineConfig machine = GetParam().move.machine();
        machine.timing = {};
        return machine;
    }
    std::vector<double> parked_mm() const {
        std::vector<double> places;
        for (const AxisConfig& axis : vm.machine().axes) { places.push_back(axis.homing.park_mm); }
        return places;
    }
    Program program() const {
        Program program{.name = "test", .axes = {}, .start_mm = parked_mm()};
        for (const AxisConfig& axis : vm.machine().axes) { program.axes.push_back(axis.name); }
        const CurvedMove& move = GetParam().move;
        program.blocks.push_back({.action = ProgramMove{move.to_mm, GetParam().feed_mm_min / 60, false, move.arc}});
        return program;
    }
    bool rests() const {
        return vm.state()->phase == MachinePhase::Holding &&
               std::ranges::all_of(vm.axis_states(), [](const auto& state) { return state->at_rest; });
    }
};

TEST_P(HoldOnACurve, BrakesAsSoonAsOnALine) {
    constexpr double kPathRest_ms = 260;  // docs/protocol.md, with the default timing
    const double speed_mm_s = GetParam().feed_mm_min / 60;
    const double braking_ms = 1000 * speed_mm_s / vm.machine().axes[kX].max_decel_mm_s2;
    home();
    ASSERT_EQ(run(program()).status, ReplyStatus::Accepted);
    wait(1);
    for (int holds = 0; holds < 4; ++holds) {
        ASSERT_EQ(vm.state()->phase, MachinePhase::Running) << describe();
        (void)vm.command(CommandKind::Hold);
        const Tick commanded = vm.now();
        EXPECT_TRUE(vm.advance_until([&] { return rests(); }, Ticks{10'000'000})) << describe();
        EXPECT_LE(static_cast<double>((vm.now() - commanded).value) / 1000, kPathRest_ms + 1.5 * braking_ms);
        ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
        wait(0.61 + 0.05 * holds);
    }
}

INSTANTIATE_TEST_SUITE_P(Moves, HoldOnACurve,
                         testing::Values(SlowMove{kArc, 10}, SlowMove{kArc, 60}, SlowMove{kArc, 600},
                                         SlowMove{kScrew, 10}, SlowMove{kScrew, 60}, SlowMove{kScrew, 600},
                                         SlowMove{kDelta, 10}, SlowMove{kDelta, 60}, SlowMove{kDelta, 600}),
                         [](const auto& slow) {
                             return slow.param.move.name + std::to_string(std::lround(slow.param.feed_mm_min));
                         });

}  // namespace
}  // namespace lockstep
