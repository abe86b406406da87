// The runs that the plan allows each axis after its newest recorded run. A process that ends may leave steps of these
// without a record of their run.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "clients/verification/jobs/epoch_check.hpp"
#include "clients/verification/steps/left_steps.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep::verification {

class PlannedCourses {
public:
    /// A copy of the replay makes the frames ahead, because the epoch's own frames may still be planned differently.
    void plan(const EpochCheck& epoch) {
        EpochReplay ahead = epoch.replay();
        const std::vector<std::string> motors = motor_names(epoch.machine());
        for (const MotorIndex i : motor_indices(motors.size())) { planned_[motors[i]] = epoch.courses_of(i, ahead); }
    }
    /// From a step at that tick on. Empty if there are none.
    std::vector<Course> of(const std::string& axis, Tick tick) const {
        const auto found = planned_.find(axis);
        if (found == planned_.end() || found->second.empty()) { return {}; }
        const Run& last = found->second.back().back();
        return tick < last.start + last.ticks() ? found->second : std::vector<Course>{};
    }

private:
    std::map<std::string, std::vector<Course>> planned_;  // by axis
};

}  // namespace lockstep::verification
