#include "tests/simulation/simtest/draw/draw_plant_fault.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/protocol/rules.hpp"

namespace lockstep::simtest {
namespace {

/// More than the rounding of a step, at most a twentieth of the travel. One of several motors of an axis cannot be
/// pushed further than the axis bears.
std::int64_t draw_push(Draw& draw, const MotorConfig& motor, const std::optional<double>& max_skew_mm) {
    const double travel = (motor.position_max_mm - motor.position_min_mm) * motor.steps_per_mm;
    const double most = max_skew_mm ? *max_skew_mm * motor.steps_per_mm : travel;
    const auto steps = static_cast<std::int64_t>(draw.magnitude(6, std::max(7.0, std::min(most, travel) / 20)));
    return draw.chance(0.5) ? steps : -steps;
}

VirtualFault draw_of(Draw& draw, const MachineConfig& machine, FaultKind kind, double lasts_slots) {
    VirtualFault fault{.kind = kind, .process = draw.index(motor_count(machine)), .lasts = {1}};
    if (kind == FaultKind::Push) {
        fault.process %= moving_motor_count(machine);  // a board has no slide
        const MotorConfig motor = motors_of(machine)[fault.process];
        fault.push_steps = draw_push(draw, motor, machine.axes[*motor.axis].max_skew_mm);
    }
    if (kind != FaultKind::Stick) { return fault; }
    fault.contact = draw.chance(0.5) ? &PlantInputs::limit_min : &PlantInputs::limit_max;
    const double slots = std::max(1.0, lasts_slots);
    fault.lasts = {static_cast<std::int64_t>(slots * static_cast<double>(machine.slot_ticks().value))};
    return fault;
}

VirtualFault draw_loss(Draw& draw, const MachineConfig& machine) {
    const FaultKind kind = draw.any_of({FaultKind::KillDevice, FaultKind::KillDevice, FaultKind::StopDevice,
                                        FaultKind::StopDevice, FaultKind::Overwrite});
    VirtualFault fault{.kind = kind, .process = draw.index(motor_count(machine))};
    const auto silence = static_cast<double>(rules::silence_slots(machine.timing));
    const bool is_short = kind == FaultKind::StopDevice && draw.chance(0.4);
    const double slots = is_short ? draw.real(0.1, silence / 2) : silence * draw.magnitude(1.5, 20);
    fault.lasts = {std::max<std::int64_t>(1, std::llround(slots * static_cast<double>(machine.slot_ticks().value)))};
    fault.garbage = draw.chance(0.5);
    return fault;
}

double slots_of(double seconds, const MachineConfig& machine) {
    return seconds * 1e6 / static_cast<double>(machine.timing.slot_us);
}

}  // namespace

PlannedFault draw_plant_fault(Draw& draw, const MachineConfig& machine) {
    const FaultKind kind = draw.any_of({FaultKind::Stick, FaultKind::Stick, FaultKind::Stick, FaultKind::Push,
                                        FaultKind::Push, FaultKind::DamageFrame});
    PlannedFault planned{.fault = draw_of(draw, machine, kind, draw.magnitude(1, 10.0 * machine.timing.frame_slots))};
    if (kind == FaultKind::Stick && draw.chance(0.1)) { planned.fault.contact = &PlantInputs::home; }
    planned.frame = draw.chance(0.3) ? 1 : 1 + static_cast<FrameNumber>(draw.magnitude(1, 60));
    planned.edge = static_cast<PlannedFault::Edge>(draw.index(PlannedFault::kFrameEdges));
    planned.slots = draw.chance(0.5) ? draw.real(-2, 2) : draw.real(0, machine.timing.frame_slots);
    if (kind != FaultKind::Stick || !draw.chance(0.25)) { return planned; }
    // The switch is closed before the axis makes its first step.
    planned.frame = 1;
    planned.edge = PlannedFault::Edge::FirstSend;
    const int until_moving = machine.timing.send_ahead_slots + machine.timing.frame_slots;
    planned.fault.lasts = std::max(planned.fault.lasts, machine.slot_ticks() * until_moving);
    return planned;
}

PlannedFault draw_device_fault(Draw& draw, const MachineConfig& machine) {
    PlannedFault planned{.fault = draw_loss(draw, machine)};
    planned.frame = draw.chance(0.3) ? 1 : 1 + static_cast<FrameNumber>(draw.magnitude(1, 60));
    planned.edge = static_cast<PlannedFault::Edge>(draw.index(PlannedFault::kFrameEdges));
    planned.slots = draw.chance(0.5) ? draw.real(-2, 2) : draw.real(0, machine.timing.frame_slots);
    return planned;
}

PlannedFault draw_device_fault_of_homing(Draw& draw, const MachineConfig& machine) {
    PlannedFault planned{.fault = draw_loss(draw, machine)};
    planned.slots = slots_of(draw.magnitude(0.001, 5), machine);
    return planned;
}

/// The home switch may be stuck closed, or open.
PlannedFault draw_plant_fault_of_homing(Draw& draw, const MachineConfig& machine) {
    const FaultKind kind = draw.any_of({FaultKind::Stick, FaultKind::Stick, FaultKind::Stick, FaultKind::Push});
    PlannedFault planned{.fault = draw_of(draw, machine, kind, slots_of(draw.magnitude(0.01, 10), machine))};
    // A motor that homes in place cannot know that it was pushed meanwhile.
    if (!row_of(motors_of(machine)[planned.fault.process].homing.way).searches) { planned.fault.push_steps = 0; }
    if (kind == FaultKind::Stick && draw.chance(0.6)) {
        planned.fault.contact = &PlantInputs::home;
        planned.fault.closed = draw.chance(0.5);
    }
    planned.slots = slots_of(draw.magnitude(0.001, 5), machine);
    return planned;
}

}  // namespace lockstep::simtest
