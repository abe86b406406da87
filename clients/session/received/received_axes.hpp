// The newest states that a client has received from a machine's motors, and those of its axes, which result from them.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "clients/session/follow/owner_watch.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/protocol/axis_health.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// After this time without a state, a motor or a standby counts as absent.
std::chrono::nanoseconds longest_silence(const MachineConfig& machine);

class ReceivedAxes {
public:
    explicit ReceivedAxes(const MachineConfig& machine);

    /// `now`: monotonic_now().
    void take(AxisState&& state, std::chrono::nanoseconds now);
    void take(AxisHealth&& health);

    const Kinematics& kinematics() const { return kinematics_; }
    /// The newest state of a motor, of an axis by its motors (axis_state_of), and the axis's speed in steps per tick.
    const std::optional<Received<AxisState>>& motor(MotorIndex i) const { return motors_[i]; }
    const std::optional<Received<AxisState>>& axis(AxisIndex i) const { return axes_[i]; }
    double axis_speed(AxisIndex i) const;
    /// Of a motor.
    const std::optional<AxisHealth>& health(MotorIndex motor) const { return healths_[motor]; }
    /// Whether a state came within the time after which the machine counts a motor as absent.
    bool motor_present(MotorIndex i) const { return is_recent(motors_[i]); }
    /// The same of all motors that the axis's place needs.
    bool axis_present(AxisIndex i) const { return is_recent(axes_[i]); }
    /// The names of the motors that are present.
    std::string names() const;

private:
    bool is_recent(const std::optional<Received<AxisState>>& state) const;
    std::vector<const AxisState*> motor_states() const;

    std::chrono::nanoseconds longest_silence_;
    Kinematics kinematics_;
    std::vector<std::optional<Received<AxisState>>> motors_;
    std::vector<std::optional<Received<AxisState>>> axes_;  // by their motors
    std::vector<MotorSet> needed_;                          // of each axis: motors_needed_for
    std::vector<std::optional<AxisHealth>> healths_;
};

}  // namespace lockstep
