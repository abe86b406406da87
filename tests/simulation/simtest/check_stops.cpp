#include <algorithm>

#include "tests/simulation/simtest/checks.hpp"
#include "tests/simulation/simtest/explain.hpp"

namespace lockstep::simtest {
namespace {

/// Far more than any stop on the path takes.
Ticks longest_stop(const MachineConfig& machine) {
    double seconds = 0;
    for (const AxisConfig& axis : machine.axes) {
        seconds = std::max(seconds, 2 * axis.max_velocity_mm_s / axis.max_decel_mm_s2);
    }
    return {static_cast<std::int64_t>(seconds * machine.ticks_per_second())};
}

/// A fault that the machine need not bear without a pause has begun, and its last effects are not yet over.
bool is_disturbed(const Recording& recording, Tick at) {
    const ProtocolTiming& t = recording.machine.timing;
    const Ticks after =
        recording.machine.slot_ticks() * (2 * t.send_ahead_slots + 2 * t.frame_slots) + longest_stop(recording.machine);
    return recording.lossy() || std::ranges::any_of(recording.faults, [&](const VirtualFault& fault) {
               return fault.at <= at && at <= fault.end() + after && !is_tolerable(fault, recording.machine);
           });
}

void check_emergency(const Recording& recording, const Emergency& emergency, Violations& violations) {
    const Tick ceased = emergency.asked + recording.machine.slot_ticks() * kCeaseSlots;
    const bool faulty = std::ranges::any_of(recording.faults, [&](const VirtualFault& fault) {
        return fault.at <= ceased && fault.end() >= emergency.asked;
    });
    if (recording.lossy() || faulty) { return; }
    for (std::size_t i = 0; i < recording.axes.size(); ++i) {
        for (const StepEdge& step : recording.axes[i].steps) {
            if (step.tick > ceased && step.tick <= emergency.rests) {
                violations.push_back({"emergency", i, step.tick.value, {}, "a pulse after pulses were told to cease"});
                break;
            }
        }
    }
}

}  // namespace

Violations check_stops(const Recording& recording) {
    Violations violations;
    for (const Emergency& emergency : recording.emergencies) { check_emergency(recording, emergency, violations); }
    for (const Tick tick : recording.interruptions) {
        if (!is_disturbed(recording, tick)) {
            violations.push_back({"needless stop", {}, tick.value, {}, "the machine paused for nothing"});
        }
    }
    return violations;
}

}  // namespace lockstep::simtest
