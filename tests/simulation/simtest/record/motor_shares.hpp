// Which motors move which axes, by the machine's configuration. It shares no code with core/kinematics.
#pragma once

#include <vector>

#include "core/machine.hpp"

namespace lockstep::simtest {

using Places = std::vector<double>;  // steps, of each axis or motor

/// In mm/s of the motor's way: its own limits, or what the limits of the axes demand of it.
struct MotorLimits {
    double start = 0;
    double top = 0;
    double accel = 0;  // mm/s^2
    double decel = 0;
};

class MotorShares {
public:
    explicit MotorShares(const MachineConfig& machine);

    std::size_t motors() const { return shares_.size(); }
    /// Each axis is a motor.
    bool is_direct() const { return is_direct_; }
    /// Steps of a motor for each step of an axis.
    double share(std::size_t motor, std::size_t axis) const { return shares_[motor][axis]; }
    /// The place of a motor in steps.
    double place(std::size_t motor, const Places& axes) const;
    /// Steps of an axis that are a step of its coarsest motor.
    double step_of(std::size_t axis) const;
    double steps_per_mm(std::size_t motor) const { return steps_per_mm_[motor]; }
    const MotorLimits& limits(std::size_t motor) const { return limits_[motor]; }
    /// How much longer a motion may last than the axes' limits need, because motors have lower ones.
    double slower() const { return slower_; }

private:
    void add(const MachineConfig& machine, std::size_t axis, const MotorBlock* block);

    std::vector<std::vector<double>> shares_;
    std::vector<double> steps_per_mm_;
    std::vector<MotorLimits> limits_;
    double slower_ = 1;
    bool is_direct_;
};

}  // namespace lockstep::simtest
