// Where the axes are, by the counts of the motors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/kinematics/kinematics.hpp"
#include "core/machine.hpp"

namespace lockstep::analysis {

class AxisPlaces {
public:
    AxisPlaces() = default;
    /// `plays`: of the motors where set() places them, if one has backlash; empty: 0.
    explicit AxisPlaces(const MachineConfig& machine, const AxisCounts& plays = {});

    std::size_t axes() const { return mm_per_step_.size(); }
    /// Each axis is moved by a motor of its own.
    bool is_direct() const { return is_direct_; }
    double mm_per_step(AxisIndex axis) const { return mm_per_step_[axis]; }
    const std::shared_ptr<const Kinematics>& kinematics() const { return kinematics_; }
    /// The motors are here; `at_mm`: one number for each axis, in mm or degrees.
    void set(std::span<const std::int64_t> counts, std::span<double> at_mm);
    /// A motor has moved to `count`. Changes the places of the axes that it moves.
    void go_to(MotorIndex motor, std::int64_t count, std::span<double> at_mm) {
        if (is_direct_) {
            at_mm[motor] = static_cast<double>(count) * mm_per_step_[motor];
        } else {
            go_by_map(motor, count, at_mm);
        }
    }

private:
    void go_by_map(MotorIndex motor, std::int64_t count, std::span<double> at_mm);
    void place(AxisIndex axis, std::span<double> at_mm) const {
        at_mm[axis] = kinematics_->axis_steps(axis, motors_) * mm_per_step_[axis];
    }

    std::shared_ptr<const Kinematics> kinematics_;
    bool is_direct_ = true;
    std::vector<double> mm_per_step_;            // of each axis
    std::vector<Position> motors_;               // their slides, unless it is direct
    std::vector<Play> plays_;                    // of each motor
    std::vector<std::vector<AxisIndex>> moved_;  // the axes that each motor moves
};

}  // namespace lockstep::analysis
