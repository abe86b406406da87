// A job of the record, with what planning its program again gives.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "clients/verification/findings.hpp"
#include "clients/verification/jobs/epoch_check.hpp"
#include "clients/verification/jobs/job_replay.hpp"
#include "core/kinematics/backlash.hpp"
#include "core/kinematics/motors.hpp"
#include "services/record/reading/program_parts.hpp"

namespace lockstep::verification {

struct CheckedJob {
    std::int64_t coordinator = 0;
    std::int64_t number = 0;
    std::string label;                // "job 2, run plate.gcode"
    std::optional<JobReplay> replay;  // none for homing and own moves
    std::optional<FrameNumber> ran;   // in its last epoch, by any axis; nullopt before the end of one
    bool is_lost = false;             // records of it are missing, so its plan is not known
    std::string broken;               // why the runs are not the whole plan; empty if they are
    std::string broken_axis;
    bool is_in_pause = false;         // it takes place in the pause of another job
    bool is_probed = false;           // its probing move ended
    MotorPositions begun_at;          // where its last epoch began
    std::vector<std::int64_t> plays;  // there, if a motor has backlash

    bool is_of(const analysis::RecordedJob& record) const {
        return number == record.job && coordinator == record.coordinator;
    }
    /// The places of the slides on the way of that epoch, if the motors have gone on in one direction.
    MotorPositions slides_of(MotorPositions motors) const {
        for (std::size_t m = 0; m < plays.size() && m < begun_at.size(); ++m) {
            Play play(replay->kinematics().motors()[m].backlash);
            play.set(plays[m]);
            play.follow(motors[m].count() - begun_at[m].count());
            motors[m] = motors[m] - Displacement::steps(play.steps());
        }
        return motors;
    }
    /// An axis did not run its whole part of an epoch.
    void break_off(const Shortfall& shortfall, const Findings& findings) {
        broken_axis = motor_name(replay->machine(), shortfall.motor);
        broken = findings.label_of(broken_axis) + " " + shortfall.text;
    }
};

}  // namespace lockstep::verification
