#include "tests/simulation/simtest/draw/draw_probes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/coordinator/program/probe_check.hpp"
#include "core/kinematics/motors.hpp"
#include "tests/simulation/simtest/draw/draw.hpp"
#include "tests/simulation/simtest/run/probe_record.hpp"

namespace lockstep::simtest {
namespace {

constexpr int kChannel = 5;
constexpr int kSecondChannel = 6;
constexpr double kAnyOvershoot_mm = 1000;

Interrupt interrupt_of(Draw& draw, Interrupt::Kind kind) {
    Interrupt interrupt{.kind = kind, .wrong = {}};
    interrupt.after_s = draw.chance(0.2) ? 0 : draw.magnitude(0.002, 3);
    interrupt.rest_s = draw.magnitude(0.001, 0.1);
    return interrupt;
}

/// Slows the probing move so that any probe bears it, wherever it begins. At a speed at which each axis alone has half
/// of its deceleration left, a move of several has so much, in steps of the slowest of them.
void bear(const MachineConfig& machine, ProgramMove& move) {
    double least_decel = std::numeric_limits<double>::max();
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        const Braking braking = Braking::of_axis(machine, i);
        while (braking.mm_s2(move.feed_mm_s) < braking.mm_s2(0) / 2) { move.feed_mm_s *= 0.7; }
        least_decel = std::min(least_decel, braking.mm_s2(0));
    }
    const Braking together(least_decel / 2 / std::sqrt(static_cast<double>(machine.axes.size())));
    for (const std::size_t input : probe_inputs(machine)) {
        const double most = greatest_probing_feed_mm_s(machine, machine.inputs[input], together);
        move.feed_mm_s = std::min(move.feed_mm_s, most);
    }
}

/// A straight move of all axes to somewhere within their travel.
Program draw_probing(Draw& draw, const MachineConfig& machine) {
    Program program{.name = "probe", .axes = {}, .start_mm = {}, .blocks = {}};
    ProgramMove move{.feed_mm_s = draw.magnitude(0.5, 30), .is_feed_fixed = true};
    for (const AxisConfig& axis : machine.axes) {
        program.axes.push_back(axis.name);
        move.target_mm.push_back(draw.real(axis.position_min_mm, axis.position_max_mm));
    }
    bear(machine, move);
    program.blocks.push_back({1, Probe{.must_touch = draw.chance(0.7)}});
    program.blocks.push_back({2, std::move(move)});
    return program;
}

Task draw_probing_task(Draw& draw, const Scenario& scenario) {
    Task task{draw_probing(draw, scenario.machine), {}, {}, {}};
    if (draw.chance(0.2)) { task.interrupts.push_back(interrupt_of(draw, Interrupt::Kind::HoldAndResume)); }
    if (draw.chance(0.9)) { task.interrupts.push_back(interrupt_of(draw, Interrupt::Kind::Touch)); }
    if (draw.chance(0.1)) {
        task.interrupts.insert(task.interrupts.begin(), interrupt_of(draw, Interrupt::Kind::Stop));
    }
    if (draw.chance(0.5)) { task.faults = scenario.tasks[draw.index(scenario.tasks.size())].faults; }
    return task;
}

InputConfig draw_input(Draw& draw, const MachineConfig& machine, std::string name, int channel) {
    const std::size_t motor = draw.index(motor_count(machine));
    return {.name = std::move(name),
            .motor = motor_name(machine, MotorIndex{motor}),
            .at_board = motor >= moving_motor_count(machine),
            .channel = channel,
            .use = InputUse::Probe,
            .active_low = draw.chance(0.5),
            .debounce_ms = draw.chance(0.3) ? 0 : draw.magnitude(0.01, 10),
            .number = 0,
            .max_overshoot_mm = kAnyOvershoot_mm};
}

/// Another input of the probe, and which of the two touch, in which order.
void give_second_input(Draw draw, Scenario& scenario) {
    if (draw.chance(0.5)) { return; }
    scenario.machine.inputs.push_back(draw_input(draw, scenario.machine, "second", kSecondChannel));
    for (Task& task : scenario.tasks) {
        if (is_probing(task.program)) {
            bear(scenario.machine, std::get<ProgramMove>(task.program.blocks.back().action));
        }
        for (Interrupt& interrupt : task.interrupts) {
            if (interrupt.kind != Interrupt::Kind::Touch) { continue; }
            interrupt.touched = draw.index(2);
            if (draw.chance(0.7)) { interrupt.next_after_s = draw.chance(0.2) ? 0 : draw.magnitude(0.00001, 0.1); }
        }
    }
}

}  // namespace

void give_probes(std::uint64_t seed, Scenario& scenario) {
    Draw draw(seed ^ 0x9408e9408e9408e9U);
    scenario.machine.inputs.push_back(draw_input(draw, scenario.machine, "probe", kChannel));
    for (std::int64_t n = draw.whole(1, 3); n > 0; --n) {
        const auto place = draw.index(scenario.tasks.size());
        scenario.tasks.insert(scenario.tasks.begin() + static_cast<std::ptrdiff_t>(place),
                              draw_probing_task(draw, scenario));
    }
    give_second_input(Draw(seed ^ 0x2c0ffee2c0ffeeU), scenario);
}

}  // namespace lockstep::simtest
