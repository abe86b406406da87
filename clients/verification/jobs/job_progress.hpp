// The job in progress: compares its records, epochs and events with what planning its program again gives.
//
// Where records of the job are missing, its plan is not known, and its further runs are left out.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clients/verification/findings.hpp"
#include "clients/verification/jobs/epoch_check.hpp"
#include "clients/verification/jobs/event_check.hpp"
#include "clients/verification/jobs/job_replay.hpp"
#include "clients/verification/jobs/open_questions.hpp"
#include "clients/verification/jobs/record_order.hpp"
#include "clients/verification/steps/left_steps.hpp"
#include "clients/verification/steps/output_check.hpp"
#include "clients/verification/steps/pulse_check.hpp"
#include "services/record/reading/program_parts.hpp"
#include "services/record/reading/run.hpp"

namespace lockstep::verification {

/// A run of an axis.
struct AxisRun {
    std::string axis;
    Run run;
    bool is_behind_gap = false;  // runs before it are missing
};

class JobProgress {
public:
    JobProgress(Findings& findings, EventCheck& events, OpenQuestions& questions)
        : findings_(findings), events_(events), questions_(questions) {}

    /// Called for each run that is as planned, with the planned changes of outputs in it.
    using OnOutputs = std::function<void(const std::string& axis, OutputCheck::Planned planned)>;
    void pass_outputs(OnOutputs on_outputs) { on_outputs_ = std::move(on_outputs); }

    /// The next record in order.
    void take(const OrderedRecord& record);
    /// Records before this one are missing: from here on the plan of the job is not known. Call it before take().
    void lose(const OrderedRecord& record);
    /// The next run of an axis, of the epoch in progress.
    void take(const AxisRun& of);
    bool is_in_epoch(Epoch epoch) const { return epoch_ && epoch_->epoch() == epoch; }
    /// Whether the runs of this epoch are left out.
    bool is_lost(Epoch epoch) const { return std::ranges::find(lost_epochs_, epoch) != lost_epochs_.end(); }
    void note_lost(Epoch epoch);

    bool has_job() const { return job_.has_value(); }
    bool has_epoch() const { return epoch_.has_value(); }
    /// The coordinator of the job, if there is one.
    bool is_run_by(std::int64_t coordinator) const { return job_ && job_->coordinator == coordinator; }
    /// "job 2, run plate.gcode". There must be a job.
    const std::string& label() const { return job_->label; }

    /// The log ends while the job is in motion, or after all axes have come to rest.
    void leave_in_motion();
    void leave_at_rest(const LogEnd& end);

    /// The motion at a tick of a run: "job 2, run plate.gcode, line 57, epoch 9, frame 12".
    std::string commanded(const Run& run, Tick tick) const;
    /// The runs that the plan allows an axis after its newest run, from a step at that tick on. Empty if there are
    /// none.
    std::vector<Course> planned(const std::string& axis, Tick tick);
    /// A difference in the job in progress, if there is one.
    void differ(std::string text, const std::string& axis = {}, const Run* run = nullptr);

private:
    struct Job {
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

        /// The places of the slides on the way of that epoch, if the motors have gone on in one direction.
        MotorPositions slides_of(MotorPositions motors) const;
    };

    void note_owner(const RecordedJob& record);
    void begin(const OrderedRecord& record);
    bool begins_in_pause(const OrderedRecord& record) const;
    void begin_epoch(const RecordedJob& record);
    void take_overrides(const RecordedJob& record);
    void take_probe(const RecordedJob& record);
    void end(const RecordedJob& record);
    void close_epoch(bool goes_on, bool lacks_events);
    void lose_epoch();
    void leave_job_plan(Epoch epoch);
    void check_epoch(bool lacks_events);
    void note_pulses();
    void break_off(const Shortfall& shortfall);
    bool suspect(const Shortfall& shortfall);
    bool is_of_job(const RecordedJob& record) const;
    void plan_next(EpochReplay replay);
    void note_outputs(const AxisRun& of, std::size_t axis);

    static constexpr std::size_t kLabelsKept = 16;

    Findings& findings_;
    EventCheck& events_;
    OpenQuestions& questions_;
    std::optional<Job> job_;
    std::optional<Job> paused_;  // the job in whose pause job_ takes place
    std::optional<EpochCheck> epoch_;
    bool knows_outputs_ = false;                // in the epoch
    std::map<std::string, PulseCheck> pulses_;  // in the epoch, of motors whose devices make pulses at places
    OnOutputs on_outputs_;
    std::deque<Epoch> lost_epochs_;                       // the newest whose plan is not known
    std::deque<std::pair<Epoch, std::string>> labels_;    // of the newest epochs
    std::map<std::string, std::vector<Course>> planned_;  // by axis: what may follow its newest run
};

}  // namespace lockstep::verification
