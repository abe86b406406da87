// The job in progress: compares its records, epochs and events with what planning its program again gives.
//
// Where records of the job are missing, its plan is not known, and its further runs are left out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "clients/verification/events/event_check.hpp"
#include "clients/verification/events/touch_check.hpp"
#include "clients/verification/findings.hpp"
#include "clients/verification/jobs/checked_job.hpp"
#include "clients/verification/jobs/epoch_progress.hpp"
#include "clients/verification/jobs/newest_epochs.hpp"
#include "clients/verification/jobs/open_questions.hpp"
#include "clients/verification/jobs/record_order.hpp"
#include "services/record/reading/program_parts.hpp"
#include "services/record/reading/run.hpp"

namespace lockstep::verification {

class JobProgress {
public:
    JobProgress(Findings& findings, EventCheck& events, TouchCheck& touches, OpenQuestions& questions,
                NewestEpochs& epochs, PlannedOutputs::OnOutputs on_outputs)
        : findings_(findings),
          events_(events),
          touches_(touches),
          questions_(questions),
          epochs_(epochs),
          epoch_(findings, events, questions, epochs, std::move(on_outputs)) {}

    /// The next record in order.
    void take(const OrderedRecord& record);
    /// Records before this one are missing: from here on the plan of the job is not known. Call it before take().
    void lose(const OrderedRecord& record);
    /// The next run of an axis, of the epoch in progress.
    void take(const AxisRun& of);

    bool has_job() const { return job_.has_value(); }
    /// The coordinator of the job, if there is one.
    bool is_run_by(std::int64_t coordinator) const { return job_ && job_->coordinator == coordinator; }
    /// "job 2, run plate.gcode". There must be a job.
    const std::string& label() const { return job_->label; }
    EpochProgress& epoch() { return epoch_; }

    /// The log ends while the job is in motion, or after all axes have come to rest.
    void leave_in_motion();
    void leave_at_rest(const LogEnd& end);

    /// The motion at a tick of a run: "job 2, run plate.gcode, line 57, epoch 9, frame 12".
    std::string commanded(const Run& run, Tick tick) const;
    /// A difference in the job in progress, if there is one.
    void differ(std::string text, const std::string& axis = {}, const Run* run = nullptr);

private:
    void note_owner(const RecordedJob& record);
    void begin(const OrderedRecord& record);
    void begin_epoch(const RecordedJob& record);
    void take_overrides(const RecordedJob& record);
    void take_probe(const RecordedJob& record);
    RecordedTouch touch_of(const RecordedJob& record) const;
    void end(const RecordedJob& record);
    void leave_job_plan(Epoch epoch);
    bool is_of_job(const RecordedJob& record) const { return job_ && job_->is_of(record); }

    Findings& findings_;
    EventCheck& events_;
    TouchCheck& touches_;
    OpenQuestions& questions_;
    NewestEpochs& epochs_;
    std::optional<CheckedJob> job_;
    std::optional<CheckedJob> paused_;  // the job in whose pause job_ takes place
    EpochProgress epoch_;
};

}  // namespace lockstep::verification
