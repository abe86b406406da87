#include "tests/simulation/simtest/draw/draw_fault.hpp"

#include <algorithm>
#include <vector>

#include "core/clock/clock_asker.hpp"

namespace lockstep::simtest {
namespace {

Ticks ticks_of(double slots, const MachineConfig& machine) {
    return {
        std::max<std::int64_t>(1, static_cast<std::int64_t>(slots * static_cast<double>(machine.slot_ticks().value)))};
}

/// Shorter than the protocol tolerates, exactly as long, slightly longer, or much longer.
double draw_freeze_slots(Draw& draw, const ProtocolTiming& t) {
    switch (draw.index(6)) {
        case 0: return draw.real(0.1, t.stall_slots);
        case 1:
        case 2: return t.stall_slots;
        case 3: return draw.real(t.stall_slots, t.check_slots());
        case 4: return draw.real(t.stall_slots, 2.0 * t.frame_slots);
        default: return draw.real(1, 8.0 * t.freshness_slots + 30);
    }
}

/// Between the time of one message and far more than any process waits for a message.
double draw_outage_slots(Draw& draw, const ProtocolTiming& t) {
    return draw.chance(0.6) ? draw.magnitude(0.5, 2.0 * t.frame_slots) : draw.real(1, 10.0 * t.freshness_slots + 40);
}

void draw_cut(Draw& draw, VirtualFault& fault, std::size_t processes) {
    if (draw.chance(0.6)) { fault.peer = (fault.process + 1 + draw.index(processes - 1)) % processes; }
    const std::size_t way = draw.index(4);
    fault.outgoing = way != 1;
    fault.incoming = way != 2;
}

/// Sets a clock by one slot to ten seconds. (An error below a round trip looks like delay.) The error ends when two
/// exchanges have shown it.
VirtualFault clock_set(Draw& draw, const MachineConfig& machine) {
    VirtualFault fault{.kind = FaultKind::SetClock, .process = draw.index(motor_count(machine))};
    const double by_s =
        (draw.chance(0.5) ? 1 : -1) * draw.magnitude(1e-6 * static_cast<double>(machine.timing.slot_us), 10);
    fault.set_by = {static_cast<std::int64_t>(by_s * machine.ticks_per_second())};
    fault.lasts = {static_cast<std::int64_t>(6 * ClockAsker::kPeriod_s * machine.ticks_per_second())};
    return fault;
}

std::optional<VirtualFault> draw_event(Draw& draw, const MachineConfig& machine, const FaultKinds& faults) {
    std::vector<VirtualFault> kinds;
    if (faults.freeze) { kinds.push_back({.kind = FaultKind::Freeze}); }
    if (faults.crash) { kinds.push_back({.kind = FaultKind::Crash}); }
    if (faults.partition) { kinds.push_back({.kind = FaultKind::Cut}); }
    if (faults.stall) { kinds.push_back({.kind = FaultKind::Freeze, .in_loop = true}); }
    if (faults.clock) { kinds.push_back({.kind = FaultKind::SetClock}); }
    if (kinds.empty() || draw.chance(0.1)) { return std::nullopt; }
    const std::size_t processes = motor_count(machine) + 1;
    VirtualFault fault = kinds[draw.index(kinds.size())];
    if (fault.kind == FaultKind::SetClock) { return clock_set(draw, machine); }
    fault.process = draw.chance(0.35) ? motor_count(machine) : draw.index(processes);
    const double slots = fault.kind == FaultKind::Freeze ? draw_freeze_slots(draw, machine.timing)
                                                         : draw_outage_slots(draw, machine.timing);
    fault.lasts = ticks_of(slots, machine);
    if (fault.kind == FaultKind::Cut) { draw_cut(draw, fault, processes); }
    return fault;
}

}  // namespace

std::optional<PlannedFault> draw_fault(Draw& draw, const MachineConfig& machine, const FaultKinds& faults) {
    const auto event = draw_event(draw, machine, faults);
    if (!event) { return std::nullopt; }
    PlannedFault planned{.fault = *event};
    planned.epoch = draw.chance(0.8) ? 0 : 1;
    planned.frame = draw.chance(0.4) ? 1 + draw.index(3) : 1 + static_cast<FrameNumber>(draw.magnitude(1, 100));
    planned.edge = static_cast<PlannedFault::Edge>(draw.index(PlannedFault::kFrameEdges));
    planned.slots = draw.chance(0.7) ? draw.real(-2, 2) : draw.real(0, machine.timing.frame_slots);
    // In this one slot of a frame a cut separates a process after the others got its message, before it gets theirs.
    const bool cut_off = event->kind == FaultKind::Cut && !event->peer && event->outgoing && event->incoming;
    if (cut_off && draw.chance(0.5)) {
        planned.edge = PlannedFault::Edge::Evidence;
        planned.slots = draw.real(0, 1);
        const int whole_round = machine.timing.freshness_slots + machine.timing.check_slots();
        planned.fault.lasts = std::max(planned.fault.lasts, machine.slot_ticks() * whole_round);
    }
    return planned;
}

std::optional<PlannedFault> draw_homing_fault(Draw& draw, const MachineConfig& machine, const FaultKinds& faults) {
    const auto event = draw_event(draw, machine, faults);
    if (!event) { return std::nullopt; }
    const double seconds = draw.magnitude(0.001, 2);
    return PlannedFault{.fault = *event, .slots = seconds * 1e6 / static_cast<double>(machine.timing.slot_us)};
}

}  // namespace lockstep::simtest
