#include <algorithm>
#include <cstdlib>

#include "tests/simulation/simtest/check/checks.hpp"
#include "tests/simulation/simtest/record/explain.hpp"

namespace lockstep::simtest {
namespace {

/// True: a fault that the machine need not tolerate without a pause affected the epoch that ended at this tick.
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

/// Whether a fault of any process lasts at some time between the two instants.
bool is_faulty(const Recording& recording, Tick from, Tick until) {
    return std::ranges::any_of(recording.faults,
                               [&](const VirtualFault& fault) { return fault.at <= until && fault.end() >= from; });
}

/// When a motor makes no pulse any more. The device with the input does not wait for a message, the others wait also
/// for the state of its motor.
Tick ceases_by(const Recording& recording, const Emergency& emergency, std::size_t motor) {
    const Ticks rounding{2};  // conversion from the device's time to the true time
    const Ticks slot = recording.machine.slot_ticks();
    if (!emergency.by_input) { return emergency.asked + slot * kCeaseSlots; }
    if (motor == *emergency.by_input) { return emergency.asked + emergency.debounce + rounding; }
    const Ticks late = recording.motors[*emergency.by_input].lateness + recording.motors[motor].lateness;
    return emergency.asked + emergency.debounce + late + slot * kInputCeaseSlots;
}

void check_emergency(const Recording& recording, const Emergency& emergency, Violations& violations) {
    const Tick all_ceased =
        emergency.asked + emergency.debounce + recording.machine.slot_ticks() * std::max(kCeaseSlots, kInputCeaseSlots);
    if (recording.lossy() || is_faulty(recording, emergency.asked, all_ceased)) { return; }
    for (std::size_t i = 0; i < recording.motors.size(); ++i) {
        const Tick ceased = ceases_by(recording, emergency, i);
        for (const StepEdge& step : recording.motors[i].steps) {
            const Tick tick = recording.motors[i].truth(step);
            if (tick > ceased && tick <= emergency.rests) {
                violations.push_back({"emergency", i, tick.value, {}, "a pulse after the limit for an emergency stop"});
                break;
            }
        }
    }
}

/// Whether the device is stopped at this tick. When it continues, it makes the pulses of this time with their old
/// ticks.
bool is_stopped(const Recording& recording, std::size_t axis, Tick tick) {
    return std::ranges::any_of(recording.faults, [&](const VirtualFault& fault) {
        return fault.kind == VirtualFault::Kind::StopDevice && fault.process == axis && fault.at <= tick &&
               tick <= fault.end();
    });
}

/// The device makes no pulse towards a limit switch that is closed.
void check_limit(const Recording& recording, const VirtualFault& fault, Violations& violations) {
    const bool is_limit =
        fault.kind == VirtualFault::Kind::Stick && fault.closed && fault.contact != &PlantInputs::home;
    if (!is_limit) { return; }
    const int towards = fault.contact == &PlantInputs::limit_min ? -1 : 1;
    const Ticks rounding{2};  // conversion from the device's time to the true time
    for (const StepEdge& step : recording.motors[fault.process].steps) {
        const Tick tick = recording.motors[fault.process].truth(step);
        if (step.direction != towards || tick <= fault.at + rounding || tick + rounding > fault.end()) { continue; }
        if (is_stopped(recording, fault.process, tick)) { continue; }
        violations.push_back({"limit", fault.process, tick.value, {}, "a pulse towards a limit switch that is closed"});
        return;
    }
}

/// The machine reports a motion that was cut short before it begins anything else.
void check_cut_is_reported(const Recording& recording, std::size_t i, const Track& track, Violations& violations) {
    const auto next = recording.epochs.upper_bound(track.epoch);
    if (!track.cut || track.epoch == 0 || next == recording.epochs.end()) { return; }
    if (recording.epochs.at(track.epoch).ceases.contains(MotorIndex{i})) { return; }
    const bool reported = std::ranges::any_of(recording.machine_faults, [&](Tick tick) {
        return tick >= recording.epochs.at(track.epoch).first_sent && tick <= next->second.first_sent;
    });
    if (reported) { return; }
    violations.push_back({"limit", i, track.start.value, {}, "its motion was cut short, and the machine continues"});
}

/// If no other fault occurs, the machine is in Fault when a device is lost for longer than its axis waits for it.
void check_loss_is_reported(const Recording& recording, const VirtualFault& fault, Violations& violations) {
    constexpr Slot kNoticed = 10;  // from the axis's reading of the device to the coordinator's Fault
    const Ticks patience = recording.machine.slot_ticks() * (rules::silence_slots(recording.machine.timing) + kNoticed);
    const bool alone = recording.faults.size() == 1 && !recording.lossy() && recording.emergencies.empty();
    if (!alone || !fault.is_of_device() || fault.lasts <= patience) { return; }
    const bool reported = std::ranges::any_of(
        recording.machine_faults, [&](Tick tick) { return fault.at <= tick && tick <= fault.at + patience; });
    if (!reported) {
        violations.push_back(
            {"device", fault.process, fault.at.value, {}, "its device is lost, but the machine reports no Fault"});
    }
}

/// An axis that is ordered to halt brakes within kHaltSlots and kHalt_ns, independently of the others. Until its next
/// order no body of the axis's own moves lasts longer. A body of one step lasts as long as the step.
void check_halt(const Recording& recording, std::size_t i, const GivenOrder& halt, Tick until, Violations& violations) {
    const Ticks within = recording.machine.slot_ticks() * kHaltSlots + Ticks{kHalt_ns / recording.machine.tick_ns};
    const Tick braked = halt.at + within;
    if (recording.lossy() || is_faulty(recording, halt.at, braked)) { return; }
    for (const Track& track : recording.motors[i].tracks) {
        const bool is_own = track.epoch == 0 && !track.tail && track.commanded < until;
        if (is_own && track.commanded + track.commanded_ticks > braked && std::abs(track.net_steps) > 1) {
            violations.push_back(
                {"halt", i, track.commanded.value, {}, "a move of its own goes on after the order to halt"});
            return;
        }
    }
}

void check_halts(const Recording& recording, std::size_t i, Violations& violations) {
    const std::vector<GivenOrder>& orders = recording.motors[i].orders;
    for (std::size_t n = 0; n < orders.size(); ++n) {
        if (orders[n].order.kind != AxisCommandKind::Halt) { continue; }
        check_halt(recording, i, orders[n], n + 1 < orders.size() ? orders[n + 1].at : recording.ended, violations);
    }
}

}  // namespace

Violations check_stops(const Recording& recording) {
    Violations violations;
    for (const Emergency& emergency : recording.emergencies) { check_emergency(recording, emergency, violations); }
    for (const Tick tick : recording.interruptions) {
        if (!is_disturbed(recording, tick)) {
            violations.push_back({"needless stop", {}, tick.value, {}, "the machine paused without a reason"});
        }
    }
    for (const VirtualFault& fault : recording.faults) {
        check_limit(recording, fault, violations);
        check_loss_is_reported(recording, fault, violations);
    }
    for (std::size_t i = 0; i < recording.motors.size(); ++i) {
        for (const Track& track : recording.motors[i].tracks) {
            check_cut_is_reported(recording, i, track, violations);
        }
        check_halts(recording, i, violations);
    }
    return violations;
}

}  // namespace lockstep::simtest
