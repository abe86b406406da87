#include <algorithm>

#include "tests/simulation/simtest/checks.hpp"
#include "tests/simulation/simtest/explain.hpp"

namespace lockstep::simtest {
namespace {

/// Something that the machine need not bear without a pause had a say in the epoch that was over at this tick.
bool is_disturbed(const Recording& recording, Tick over) {
    if (recording.lossy()) { return true; }
    Tick begun = recording.began;
    for (const Tick tick : recording.epochs_begun) { begun = tick < over ? tick : begun; }
    const Ticks echo = recording.machine.slot_ticks() * recording.machine.timing.send_ahead_slots;
    return std::ranges::any_of(recording.faults, [&](const VirtualFault& fault) {
        const bool meets = fault.at <= over && fault.end() + echo >= begun;
        return meets && !is_tolerable(fault, recording.machine);
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
            const Tick tick = recording.axes[i].truth(step);
            if (tick > ceased && tick <= emergency.rests) {
                violations.push_back({"emergency", i, tick.value, {}, "a pulse after pulses were told to cease"});
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
