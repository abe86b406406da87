#include "tests/simulation/simtest/draw/machine/draw_late_devices.hpp"

#include <algorithm>

#include "tests/simulation/simtest/draw/draw.hpp"

namespace lockstep::simtest {
namespace {

constexpr std::int64_t kLeastSlot_us = 2000;
constexpr double kLeastDelay_us = 100;
constexpr double kMostDelay_us = 5000;

/// A question and its answer take 0.1 to 5 ms, and at most half a slot. The shortest takes at most a twentieth of a
/// slot, which leaves most of the allowed clock error to the network.
LinkDelay draw_link(Draw& draw, const MachineConfig& machine) {
    const auto slot_us = static_cast<double>(machine.timing.slot_us);
    const auto ticks = [&](double us) { return Ticks{static_cast<std::int64_t>(us * 1000) / machine.tick_ns}; };
    const double least = draw.real(kLeastDelay_us, std::max(kLeastDelay_us, slot_us / 20));
    return {ticks(least), ticks(draw.magnitude(least, std::min(kMostDelay_us, slot_us / 2)))};
}

/// Seconds away from the host's clock, and up to 100 ppm fast or slow.
VirtualClock draw_oscillator(Draw& draw, const MachineConfig& machine) {
    const double offset_s = (draw.chance(0.5) ? 1 : -1) * draw.magnitude(1e-6, 60);
    return {.offset = {static_cast<std::int64_t>(offset_s * machine.ticks_per_second())}, .ppm = draw.real(-100, 100)};
}

DeviceName& device_of(MachineConfig& machine, std::size_t motor) {
    std::vector<DeviceName*> devices;
    for (AxisConfig& axis : machine.axes) {
        if (axis.motors.empty()) { devices.push_back(&axis.device); }
        for (MotorBlock& block : axis.motors) { devices.push_back(&block.device); }
    }
    for (BoardConfig& board : machine.boards) { devices.push_back(&board.device); }
    return *devices[motor];
}

void shorten_network(Scenario& scenario) {
    const bool has_clocks = scenario.machine.timing.time_source == TimeSource::Network;
    const Ticks most{scenario.machine.slot_ticks().value / (has_clocks ? 16 : 4)};
    NetworkBehaviour& network = scenario.network;
    network.delay_max = std::min(network.delay_max, most);
    network.delay_min = std::min(network.delay_min, network.delay_max);
}

void leave_clocks_alone(Scenario& scenario) {
    const auto is_of_late = [&](const PlannedFault& planned) {
        return planned.fault.kind == FaultKind::SetClock && scenario.lateness(planned.fault.process) > Ticks{};
    };
    std::erase_if(scenario.homing_faults, is_of_late);
    for (Task& task : scenario.tasks) { std::erase_if(task.faults, is_of_late); }
}

}  // namespace

void give_late_devices(std::uint64_t seed, Scenario& scenario) {
    MachineConfig& machine = scenario.machine;
    if (machine.timing.slot_us < kLeastSlot_us) { return; }
    Draw draw(seed ^ 0x1a7ede71ce000000U);
    scenario.power_up = {100'000'000};  // more than any clock is behind
    machine.timing.clock_error_limit_us = machine.timing.most_clock_error_us();
    const bool has_clocks = !scenario.clocks.empty();
    if (!has_clocks) { scenario.clocks.resize(motor_count(machine)); }
    scenario.links.resize(motor_count(machine));
    for (const MotorIndex i : motor_indices(motor_count(machine))) {
        if (draw.chance(0.5)) { continue; }
        scenario.links[i] = draw_link(draw, machine);
        device_of(machine, i) = {DeviceName::Kind::Mapped, "/dev/drawn"};
        if (!has_clocks) { scenario.clocks[i].device = draw_oscillator(draw, machine); }
    }
    shorten_network(scenario);
    leave_clocks_alone(scenario);
}

}  // namespace lockstep::simtest
