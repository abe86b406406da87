#include "tests/simulation/simtest/draw/draw_inputs.hpp"

#include "core/kinematics/motors.hpp"
#include "tests/simulation/simtest/draw/draw.hpp"

namespace lockstep::simtest {
namespace {

InputConfig draw_input(Draw& draw, const MachineConfig& machine, const char* name, int channel, InputUse use) {
    const std::size_t motor = draw.index(motor_count(machine));
    return {.name = name,
            .motor = motor_name(machine, MotorIndex{motor}),
            .at_board = motor >= moving_motor_count(machine),
            .channel = channel,
            .use = use,
            .active_low = draw.chance(0.5),
            .debounce_ms = draw.chance(0.3) ? 0 : draw.magnitude(0.01, 10)};
}

Interrupt draw_change(Draw& draw) {
    Interrupt interrupt{.kind = draw.chance(0.3) ? Interrupt::Kind::StopInput : Interrupt::Kind::Door, .wrong = {}};
    interrupt.after_s = draw.chance(0.2) ? 0 : draw.magnitude(0.002, 3);
    interrupt.rest_s = draw.magnitude(0.001, 0.1);
    return interrupt;
}

}  // namespace

void give_inputs(std::uint64_t seed, Scenario& scenario) {
    Draw draw(seed ^ 0x1290751290751290U);
    const MachineConfig& machine = scenario.machine;
    const InputConfig stop = draw_input(draw, machine, "estop", 3, InputUse::EmergencyStop);
    const InputConfig door = draw_input(draw, machine, "door", 4, InputUse::Door);
    std::vector<InputConfig>& inputs = scenario.machine.inputs;
    inputs.insert(inputs.begin(), {stop, door});
    for (Task& task : scenario.tasks) {
        for (std::int64_t n = draw.whole(0, 2); n > 0; --n) {
            const auto place = draw.index(task.interrupts.size() + 1);
            task.interrupts.insert(task.interrupts.begin() + static_cast<std::ptrdiff_t>(place), draw_change(draw));
        }
    }
    // A last job shows that the machine works after an emergency stop.
    scenario.tasks.push_back({scenario.tasks.front().program, {}, {}, {}});
}

}  // namespace lockstep::simtest
