#include "tests/simulation/simtest/draw/draw_jogs.hpp"

#include <algorithm>
#include <cmath>

#include "tests/simulation/simtest/draw/draw.hpp"
#include "tests/simulation/simtest/draw/draw_fault.hpp"
#include "tests/simulation/simtest/draw/draw_plant_fault.hpp"

namespace lockstep::simtest {
namespace {

JogAxis draw_axis(Draw& draw, const AxisConfig& axis, std::size_t number) {
    JogAxis jog{.axis = AxisIndex{number}};
    const double top = axis.max_velocity_mm_s;
    jog.speed_mm_s = (draw.chance(0.5) ? 1 : -1) * (draw.chance(0.3) ? top : draw.magnitude(0.02, 1) * top);
    if (draw.chance(0.25)) {
        jog.distance_mm = draw.magnitude(1e-3, 1) * (axis.position_max_mm - axis.position_min_mm);
    }
    return jog;
}

JogPress draw_press(Draw& draw, const MachineConfig& machine) {
    JogPress press;
    const std::size_t first = draw.index(machine.axes.size());
    press.axes.push_back(draw_axis(draw, machine.axes[first], first));
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        if (i != first && draw.chance(0.25)) { press.axes.push_back(draw_axis(draw, machine.axes[i], i)); }
    }
    press.held_s = draw.magnitude(0.005, 2);
    press.end =
        draw.any_of({JogPress::End::Release, JogPress::End::Release, JogPress::End::Silence, JogPress::End::Next});
    return press;
}

/// Faults of processes, links, switches, slides or devices.
std::optional<PlannedFault> draw_jog_fault(Draw& draw, const MachineConfig& machine, const FaultKinds& faults) {
    std::optional<PlannedFault> planned = draw_fault(draw, machine, faults);
    if (faults.limit && draw.chance(0.3)) { planned = draw_plant_fault(draw, machine); }
    if (faults.device && draw.chance(0.3)) { planned = draw_device_fault(draw, machine); }
    if (planned && draw.chance(0.5)) {
        planned->at_jog = true;
        planned->slots = draw.magnitude(0.001, 2) * 1e6 / static_cast<double>(machine.timing.slot_us);
    }
    return planned;
}

}  // namespace

void give_jogs(std::uint64_t seed, const FaultKinds& faults, Scenario& scenario) {
    Draw draw(seed ^ 0x0906090609060906U);
    // Renewals arrive in time although a message may take two slots.
    constexpr double kLeast_us = 20'000;
    constexpr double kMost_us = 500'000;
    const double hold_us = draw.magnitude(6, 12) * static_cast<double>(scenario.machine.timing.slot_us);
    scenario.machine.timing.jog_hold_us = std::llround(std::clamp(hold_us, kLeast_us, kMost_us));
    for (Task& task : scenario.tasks) {
        for (std::int64_t n = draw.whole(0, 2); n > 0; --n) {
            JogSession session;
            for (std::int64_t k = draw.whole(1, 3); k > 0; --k) {
                session.presses.push_back(draw_press(draw, scenario.machine));
            }
            JogPress& last = session.presses.back();
            if (last.end == JogPress::End::Next) { last.end = JogPress::End::Release; }
            if (draw.chance(0.5)) {
                if (const auto fault = draw_jog_fault(draw, scenario.machine, faults)) {
                    session.faults.push_back(*fault);
                }
            }
            task.jogs.push_back(std::move(session));
        }
    }
    // A last job shows that the machine works after a fault in a jog.
    if (faults.breaks_processes()) { scenario.tasks.push_back({scenario.tasks.front().program, {}, {}, {}}); }
}

}  // namespace lockstep::simtest
