#include "tests/simulation/simtest/draw/draw_close_probes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/kinematics/kinematics.hpp"
#include "core/kinematics/motors.hpp"
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

/// Leaves the probing move these axes alone. Returns its feed.
double leave_axes(Draw& draw, const std::vector<std::string>& axes, double most_mm_s, Program& program) {
    auto& move = std::get<ProgramMove>(program.blocks.back().action);
    std::vector<double> target_mm;
    for (const std::string& axis : axes) {
        const auto place = std::ranges::find(program.axes, axis) - program.axes.begin();
        target_mm.push_back(move.target_mm[static_cast<std::size_t>(place)]);
    }
    move.target_mm = std::move(target_mm);
    move.feed_mm_s = std::min(move.feed_mm_s, most_mm_s * draw.real(0.3, 1));
    program.axes = axes;
    return move.feed_mm_s;
}

/// All probing moves are of these axes and end at a touch, with at most this feed. Returns the greatest feed.
double give_close_moves(Draw& draw, AxisSet axes, double most_mm_s, Scenario& scenario) {
    std::vector<std::string> names;
    for (const AxisIndex i : axes) { names.push_back(scenario.machine.axes[i].name); }
    double greatest_mm_s = 0;
    for (Task& task : scenario.tasks) {
        if (!is_probing(task.program)) { continue; }
        greatest_mm_s = std::max(greatest_mm_s, leave_axes(draw, names, most_mm_s, task.program));
        leave_one_touch(draw, task);
    }
    return greatest_mm_s;
}

/// The probe bears that the axes go on while the input follows its pin, and little more.
double little_more_mm(const MachineConfig& machine, const InputConfig& probe, double feed_mm_s, double step_mm) {
    const double seconds = probe.debounce_ms * 1e-3 + 3 / machine.ticks_per_second();
    return std::max(0.001, feed_mm_s * seconds + 1.5 * step_mm);
}

/// Whether the devices of all motors of these axes may see a switch by one wire.
bool may_be_wired(AxisSet axes, const Kinematics& kinematics) {
    const MotorSet motors = kinematics.motors_of_axes(axes);
    for (const MotorIndex m : motors) {
        if (kinematics.corrects_screw(m) || !kinematics.motors()[m].backlash.is_none()) { return false; }
    }
    return motors.size() >= 2 && motors.size() <= kMaxTouchInputs;
}

/// Several motors of one axis that have clocks of their own end by the veto.
bool end_by_veto(MotorSet motors, const MachineConfig& machine, const Kinematics& kinematics) {
    AxisSet axes;
    bool have_own_clocks = false;
    for (const MotorIndex m : motors) {
        axes |= kinematics.axes_of_motor(m);
        have_own_clocks |= estimates_clock(machine, m);
    }
    return have_own_clocks && motors.size() > axes.size();
}

/// Axes with several motors: each alone, and two together.
std::vector<AxisSet> axes_to_wire(const Kinematics& kinematics) {
    std::vector<AxisSet> found;
    for (const AxisIndex i : axis_indices(kinematics.axes())) {
        for (AxisIndex j = i; j < kinematics.axes(); ++j) {
            if (may_be_wired({i, j}, kinematics)) { found.push_back({i, j}); }
        }
    }
    return found;
}

/// With this feed no motor is faster than it starts, in whichever direction the axes go.
double feed_to_start(AxisSet axes, const Kinematics& kinematics) {
    double most_mm_s = std::numeric_limits<double>::max();
    for (const MotorIndex m : kinematics.motors_of_axes(axes)) {
        const MotorConfig& motor = kinematics.motors()[m];
        double gain = 0;
        for (const AxisIndex i : axes) { gain += 1 / (std::abs(kinematics.axis_mm(i, m)) * motor.steps_per_mm); }
        most_mm_s = std::min(most_mm_s, motor.start_velocity_mm_s / gain);
    }
    return most_mm_s;
}

/// Wires the probe's switch to the devices of all motors that probe. If its moves end by the veto, it bears what it
/// bore. Returns false if no motors are wired.
bool wire_probe(std::uint64_t seed, Scenario& scenario) {
    Draw draw(seed ^ 0x31e0ddb10c31e0ULL);
    MachineConfig& machine = scenario.machine;
    const Kinematics kinematics(machine);
    const std::vector<AxisSet> choices = axes_to_wire(kinematics);
    if (choices.empty() || draw.chance(0.4)) { return false; }
    const AxisSet axes = choices[draw.index(choices.size())];
    leave_one_input(machine.inputs);
    const std::size_t place = probe_inputs(machine).front();
    InputConfig probe = machine.inputs[place];
    machine.inputs.erase(machine.inputs.begin() + static_cast<std::ptrdiff_t>(place));
    const double feed = give_close_moves(draw, axes, feed_to_start(axes, kinematics), scenario);
    double step_mm = 0;
    for (const AxisIndex i : axes) { step_mm = std::hypot(step_mm, kinematics.step_mm(i)); }
    const MotorSet motors = kinematics.motors_of_axes(axes);
    if (!end_by_veto(motors, machine, kinematics)) {
        probe.max_overshoot_mm = little_more_mm(machine, probe, feed, step_mm);
    }
    probe.wire = "tip";
    probe.at_board = false;
    for (const MotorIndex m : motors) {
        probe.motor = kinematics.motors()[m].name;
        probe.name = "probe" + std::to_string(m);
        machine.inputs.push_back(probe);
    }
    return true;
}

}  // namespace

void bring_probe_close(std::uint64_t seed, Scenario& scenario) {
    if (wire_probe(seed, scenario)) { return; }
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
    const double feed = give_close_moves(draw, {i}, motor.start_velocity_mm_s, scenario);
    probe.max_overshoot_mm = little_more_mm(machine, probe, feed, 1 / machine.axes[i].steps_per_mm);
}

}  // namespace lockstep::simtest
