// How messages to people name the processes of a record, which serve motors.
#pragma once

#include <algorithm>
#include <map>
#include <string>

#include "core/kinematics/kinematics.hpp"

namespace lockstep::analysis {

class MotorLabels {
public:
    /// The machine of the record is known.
    void add(const Kinematics& kinematics) {
        for (const MotorIndex m : motor_indices(kinematics.motors().size())) {
            labels_[kinematics.motors()[m].name] = kinematics.label(m);
        }
    }
    /// "axis X", or "motor Y2" if the motor is known not to be its axis.
    std::string of(const std::string& motor) const {
        const auto known = labels_.find(motor);
        return known != labels_.end() ? known->second : "axis " + motor;
    }
    /// Whether a motor is known not to be its axis.
    bool has_motors() const {
        return std::ranges::any_of(labels_, [](const auto& known) { return known.second.starts_with("motor "); });
    }

private:
    std::map<std::string, std::string> labels_;  // by the names of motors
};

}  // namespace lockstep::analysis
