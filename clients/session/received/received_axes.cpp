#include "clients/session/received/received_axes.hpp"

#include <algorithm>

#include "core/kinematics/axis_states.hpp"
#include "core/protocol/rules.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep {

using std::chrono::nanoseconds;

nanoseconds longest_silence(const MachineConfig& machine) {
    const ProtocolTiming& timing = machine.timing;
    return std::max<nanoseconds>(std::chrono::seconds{1},
                                 std::chrono::microseconds{rules::silence_slots(timing) * timing.slot_us});
}

ReceivedAxes::ReceivedAxes(const MachineConfig& machine)
    : longest_silence_(longest_silence(machine)),
      kinematics_(machine),
      motors_(kinematics_.motors().size()),
      axes_(kinematics_.axes()),
      healths_(motors_.size()) {
    for (const AxisIndex i : axis_indices(axes_.size())) { needed_.push_back(motors_needed_for(i, kinematics_)); }
}

/// An axis is as old as the oldest state that its place needs.
void ReceivedAxes::take(AxisState&& state, nanoseconds now) {
    if (state.axis >= motors_.size()) { return; }
    const MotorIndex motor = state.motor();
    motors_[motor] = {std::move(state), now};
    const std::vector<const AxisState*> states = motor_states();
    for (const AxisIndex i : axis_indices(axes_.size())) {
        if (!needed_[i].contains(motor)) { continue; }
        auto axis = axis_state_of(i, kinematics_, states);
        if (!axis) { continue; }
        nanoseconds oldest = now;
        for (const MotorIndex m : needed_[i]) { oldest = std::min(oldest, motors_[m]->time); }
        axes_[i] = {*std::move(axis), oldest};
    }
}

void ReceivedAxes::take(AxisHealth&& health) {
    if (health.axis < healths_.size()) { healths_[health.axis] = health; }
}

double ReceivedAxes::axis_speed(AxisIndex i) const { return axis_speed_of(i, kinematics_, motor_states()); }

std::string ReceivedAxes::names() const {
    std::string names;
    for (const MotorIndex i : motor_indices(motors_.size())) {
        if (motor_present(i)) { names += (names.empty() ? "" : ", ") + kinematics_.motors()[i].name; }
    }
    return names;
}

bool ReceivedAxes::is_recent(const std::optional<Received<AxisState>>& state) const {
    return state && monotonic_now() - state->time <= longest_silence_;
}

std::vector<const AxisState*> ReceivedAxes::motor_states() const {
    std::vector<const AxisState*> states;
    for (const auto& motor : motors_) { states.push_back(motor ? &motor->state : nullptr); }
    return states;
}

}  // namespace lockstep
