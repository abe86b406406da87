#include "core/axis/following/output_check.hpp"

#include <variant>

#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

/// By rising ticks from 1 to `length`.
bool is_in_order(const auto& changes, Ticks length) {
    Ticks last{1};
    for (const OutputChange& change : changes) {
        if (change.at < last || change.at > length) { return false; }
        last = change.at;
    }
    return true;
}

}  // namespace

OutputCheck::OutputCheck(MotorIndex motor, const MachineConfig& machine) : room_(output_room(machine.timing)) {
    for (const OutputConfig& output : outputs_of(machine.outputs, motor_name(machine, motor))) {
        (output.is_analog() ? analog_ : output.makes_pulses() ? pulses_ : digital_) |= output.bit();
    }
}

bool OutputCheck::is_possible(const OutputChange& change) const {
    if (const auto* digital = std::get_if<SetDigital>(&change.what)) {
        return (digital->mask & ~digital_) == 0 && (digital->levels & ~digital->mask) == 0;
    }
    if (const auto* compare = std::get_if<ComparePosition>(&change.what)) {
        return pulses_ != 0 && (compare->pulses == 0 || compare->every != 0);
    }
    const auto* analog = std::get_if<RampAnalog>(&change.what);
    return analog != nullptr && (analog_ >> analog->channel & 1) != 0 && analog->value >= 0 &&
           analog->value <= kFullScale && analog->slope >= -kFullScale && analog->slope <= kFullScale;
}

FaultCode OutputCheck::check(const OutputTrack& track, Ticks body, Ticks tail) const {
    const bool has_room = track.body.size() <= room_.body && track.tail.size() <= room_.tail;
    bool holds = has_room && is_in_order(track.body, body) && is_in_order(track.tail, tail);
    for (const OutputChange& change : track.body) { holds = holds && is_possible(change); }
    for (const OutputChange& change : track.tail) { holds = holds && is_possible(change); }
    return holds ? FaultCode::None : FaultCode::OutputsImpossible;
}

}  // namespace lockstep
