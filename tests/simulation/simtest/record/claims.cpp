#include "tests/simulation/simtest/record/claims.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/protocol/frame_room.hpp"

namespace lockstep::simtest {

void ClaimCheck::on_axis(MotorIndex axis, Tick now, const AxisOutputs& out, AxisNode& node) {
    const std::int64_t encoder = vm_.device(axis).plant().encoder();
    const bool has_moved = std::exchange(encoder_[axis], encoder) != encoder || vm_.device(axis).in_motion();
    if (has_moved) { moved_[axis] = now; }
    const bool is_by_touch = by_touch_.contains(axis);
    if (!row_of(motors_[axis].homing.way).searches && !is_by_touch) { note_zero(axis, out); }
    if (!out.state) { return; }
    const AxisState& state = *out.state;
    touch_errors_.note(axis, state);
    const std::int64_t claimed = state.position.count();
    const bool lacks_device = state.unproved == FaultCode::DeviceMissing;
    if (lacks_device && state.homed) { object(axis, now, "it says that it is homed, and that it has no device"); }
    if (lacks_device) { unnoticed_[axis].reset(); }
    const bool may_not_know = has_yet_to_notice(axis);
    if (lacks_device || !has_device_[axis] || may_not_know) { return; }  // it reports where it last read the device
    // Of the steps that a device makes up at once, its ring keeps only as many as it holds.
    const std::int64_t count = claimed + node.controller().zero_count();
    if (std::exchange(made_up_[axis], {}).value_or(0) >= kDeviceCaptureEntries) { pulses_[axis] = count; }
    if (count != pulses_[axis]) {
        object(axis, now,
               "it reports step " + std::to_string(claimed) + " after " + std::to_string(pulses_[axis]) + " pulses");
    }
    if (state.at_rest && state.velocity != Velocity{}) { object(axis, now, "it reports that it rests, but moves"); }
    // An axis does not know yet what its device has done since the last reading, if the device answers late.
    const bool is_late = recording_.motors[axis].lateness > Ticks{};
    if (is_late && state.tick - state.clock_error <= moved_[axis]) { return; }
    // In motion an axis takes its play from the pieces that its device has run, and for one direction since then.
    if (recording_.motors[axis].play > 0 && !state.at_rest) { return; }
    const double slide = vm_.device(axis).plant().position_mm() * motors_[axis].steps_per_mm;
    const std::int64_t by_encoder = claimed + state.following_error_steps;
    const double is_off = slide - zero_[axis] - static_cast<double>(by_encoder - state.play_steps);
    if (state.homed && std::abs(is_off) > homed_within(axis)) {
        object(axis, now,
               "it reports that it is homed at step " + std::to_string(by_encoder) +
                   " by its encoder, its slide is at step " + std::to_string(slide));
    }
}

/// A motor that is homed in place calls the place where it stands its park.
void ClaimCheck::note_zero(std::size_t motor, const AxisOutputs& out) {
    const auto is_homed = [](const AxisNotice& notice) { return notice.kind == AxisNotice::Kind::Homed; };
    if (std::ranges::any_of(out.notices, is_homed)) { is_zero_new_[motor] = true; }
    if (!out.state || !out.state->homed || !is_zero_new_[motor]) { return; }
    is_zero_new_[motor] = false;
    zero_[motor] = vm_.device(motor).plant().position_mm() * motors_[motor].steps_per_mm -
                   static_cast<double>(out.state->position.count());
}

/// Whether the axis may not know yet that its device is lost. It gives the device up after silence_slots of its own
/// slots, later if its process stood still meanwhile.
bool ClaimCheck::has_yet_to_notice(std::size_t axis) {
    auto& states = unnoticed_[axis];
    return states && ++*states <= rules::silence_slots(vm_.machine().timing) + 1;
}

/// A device that replaces another one, or is powered up again, counts from 0. While a device is stopped or its
/// registers are overwritten, they do not show what it does, until its axis has read it again.
void ClaimCheck::on_fault(Tick /*now*/, const VirtualFault& fault, bool begins) {
    if (!fault.is_of_device()) { return; }
    has_device_[fault.process] = !begins;
    if (begins) { unnoticed_[fault.process] = 0; }
    if (fault.kind == VirtualFault::Kind::StopDevice && !begins) {
        unnoticed_[fault.process].reset();
        made_up_[fault.process] = 0;
    }
    if (!begins && fault.kind != VirtualFault::Kind::StopDevice) {
        pulses_[fault.process] = 0;
        power_up_[fault.process] = vm_.device_time(fault.process);
    }
}

void ClaimCheck::object(std::size_t axis, Tick now, const std::string& what) {
    constexpr std::size_t kEnough = 20;
    if (recording_.untrue.size() < kEnough) { recording_.untrue.push_back({"claim", axis, now.value, {}, what}); }
}

}  // namespace lockstep::simtest
