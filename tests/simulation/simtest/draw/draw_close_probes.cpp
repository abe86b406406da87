#include "tests/simulation/simtest/draw/draw_close_probes.hpp"

#include <algorithm>

#include "core/kinematics/kinematics.hpp"
#include "tests/simulation/simtest/draw/draw.hpp"
#include "tests/simulation/simtest/run/probe_record.hpp"

namespace lockstep::simtest {
namespace {

/// The axes that have a motor of their own, whose screw is exact.
std::vector<AxisIndex> axes_of_own_motors(const Kinematics& kinematics) {
    std::vector<AxisIndex> axes;
    for (const AxisIndex i : axis_indices(kinematics.axes())) {
        const auto motor = kinematics.own_motor(i);
        if (motor && !kinematics.corrects_screw(*motor)) { axes.push_back(i); }
    }
    return axes;
}

void leave_one_input(std::vector<InputConfig>& inputs) {
    const auto is_probe = [](const InputConfig& input) { return input.use == InputUse::Probe; };
    const auto first = std::ranges::find_if(inputs, is_probe);
    inputs.erase(std::remove_if(first + 1, inputs.end(), is_probe), inputs.end());
}

void leave_one_touch(Draw& draw, Task& task) {
    std::erase_if(task.interrupts, [](const Interrupt& of) { return of.kind == Interrupt::Kind::Touch; });
    Interrupt touch{.kind = Interrupt::Kind::Touch, .wrong = {}};
    touch.after_s = draw.magnitude(0.002, 3);
    touch.rest_s = draw.magnitude(0.001, 0.1);
    task.interrupts.push_back(touch);
}

/// Leaves the probing move its axis alone. Returns its feed.
double leave_one_axis(Draw& draw, const AxisConfig& axis, double most_mm_s, Program& program) {
    auto& move = std::get<ProgramMove>(program.blocks.back().action);
    const auto place = std::ranges::find(program.axes, axis.name) - program.axes.begin();
    move.target_mm = {move.target_mm[static_cast<std::size_t>(place)]};
    move.feed_mm_s = std::min(move.feed_mm_s, most_mm_s * draw.real(0.3, 1));
    program.axes = {axis.name};
    return move.feed_mm_s;
}

}  // namespace

/// The probe bears that the axis goes on while the input follows its pin, and little more.
void bring_probe_close(std::uint64_t seed, Scenario& scenario) {
    Draw draw(seed ^ 0xc105e0ddc105eULL);
    MachineConfig& machine = scenario.machine;
    const Kinematics kinematics(machine);
    const std::vector<AxisIndex> axes = axes_of_own_motors(kinematics);
    if (axes.empty()) { return; }
    const AxisIndex i = axes[draw.index(axes.size())];
    const MotorConfig& motor = kinematics.motors()[*kinematics.own_motor(i)];
    leave_one_input(machine.inputs);
    InputConfig& probe = machine.inputs[probe_inputs(machine).front()];
    probe.motor = motor.name;
    probe.at_board = false;
    double most_mm_s = 0;
    for (Task& task : scenario.tasks) {
        if (!is_probing(task.program)) { continue; }
        const double feed = leave_one_axis(draw, machine.axes[i], motor.start_velocity_mm_s, task.program);
        leave_one_touch(draw, task);
        most_mm_s = std::max(most_mm_s, feed);
    }
    const double seconds = probe.debounce_ms * 1e-3 + 3 / machine.ticks_per_second();
    probe.max_overshoot_mm = std::max(0.001, most_mm_s * seconds + 1.5 / machine.axes[i].steps_per_mm);
}

}  // namespace lockstep::simtest
