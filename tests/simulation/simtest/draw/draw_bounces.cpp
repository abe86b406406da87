#include "tests/simulation/simtest/draw/draw_bounces.hpp"

#include <algorithm>
#include <map>

#include "core/coordinator/program/probe_check.hpp"
#include "tests/simulation/simtest/draw/draw.hpp"

namespace lockstep::simtest {
namespace {

/// An axis that homes by the touch of this input goes on while it bounces, and then still stops in front of the limit
/// switch. Bounces are no longer than for half of the room, and make a slow touch differ by half of what touches may.
void leave_room(MachineConfig& machine, InputConfig& input) {
    for (AxisConfig& axis : machine.axes) {
        if (axis.homing.way != HomingWay::ByTouch || axis.homing.input != input.name) { continue; }
        HomingConfig& homing = axis.homing;
        const double half_mm = input.max_overshoot_mm / 2;
        input.simulated_bounce_ms = std::min(input.simulated_bounce_ms, half_mm / homing.search_velocity_mm_s * 1e3);
        input.max_overshoot_mm -= homing.search_velocity_mm_s * bounce_seconds(input);
        const Braking braking = Braking::of_axis(machine, machine.axis_named(axis.name).value());
        const double most = 0.99 * greatest_probing_feed_mm_s(machine, input, braking);
        homing.search_velocity_mm_s = std::min(homing.search_velocity_mm_s, most);
        homing.latch_velocity_mm_s = std::min(homing.latch_velocity_mm_s, homing.search_velocity_mm_s);
        if (input.simulated_bounce_ms > 0) {
            const double slow = homing.touch_tolerance_mm / 2 / bounce_seconds(input);
            homing.latch_velocity_mm_s = std::min(homing.latch_velocity_mm_s, slow);
        }
    }
}

}  // namespace

void give_bounces(std::uint64_t seed, Scenario& scenario) {
    Draw draw(seed ^ 0xb0c7ceb0c7ceb0c7U);
    for (InputConfig& input : scenario.machine.inputs) {
        // A switch that bounces for longer is at another place at each touch, and is a fault of its own.
        const bool is_short = draw.chance(0.5) || input.use == InputUse::Home;
        const double most_ms = is_short ? 0.9 * input.debounce_ms : 10;
        input.simulated_bounce_ms = most_ms * draw.part();
        leave_room(scenario.machine, input);
    }
    std::map<std::string, double> of_wires;  // a wire has one contact
    for (InputConfig& input : scenario.machine.inputs) {
        if (input.wire.empty()) { continue; }
        input.simulated_bounce_ms = of_wires.try_emplace(input.wire, input.simulated_bounce_ms).first->second;
    }
}

}  // namespace lockstep::simtest
