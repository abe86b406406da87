// Compares the runs of jobs with the frames that the coordinator's planning makes of their programs, bit for bit.
// Brings records and runs into the order in which the job in progress can take them: a run waits for the record of its
// epoch, and a record waits until a run needs it.
//
// Where records of jobs are missing, the rest of that job is not compared with its plan. Where runs of an axis are
// missing, its other runs still are.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "clients/verification/events/event_check.hpp"
#include "clients/verification/findings.hpp"
#include "clients/verification/jobs/first_job.hpp"
#include "clients/verification/jobs/job_progress.hpp"
#include "clients/verification/jobs/job_stream.hpp"
#include "clients/verification/jobs/newest_epochs.hpp"
#include "clients/verification/jobs/open_questions.hpp"
#include "clients/verification/jobs/record_order.hpp"
#include "clients/verification/steps/left_steps.hpp"
#include "services/record/reading/program_parts.hpp"
#include "services/record/reading/run.hpp"

namespace lockstep::verification {

using analysis::RecordedJob;
using analysis::Run;

class JobCheck {
public:
    /// The maximum number of runs that wait for the record of their epoch, which is written before they begin.
    static constexpr std::size_t kMaxWaiting = 4096;

    explicit JobCheck(Findings& findings, TouchCheck& touches, PlannedOutputs::OnOutputs on_outputs)
        : findings_(findings),
          events_(findings),
          progress_(findings, events_, touches, questions_, epochs_, std::move(on_outputs)) {}

    /// Records come in the order of their numbers. `is_behind_gap`: records of the coordinator before it are missing.
    void take(const RecordedJob& record, bool is_behind_gap);
    void take(const program_event_t& event, bool is_behind_gap);
    /// Two different records of the log have the same number.
    void contradict(const JobRecord& other);
    /// The log begins later than the record. A job that began before the log is not compared with its plan.
    void begins_late();
    /// A run of a job, or of the axis's own move, which is not compared. The runs of each axis must come in the order
    /// of their numbers. `is_behind_gap`: runs before it are missing from the log.
    void take(const std::string& axis, const Run& run, bool is_behind_gap);

    /// Call once, at the end of the log.
    void finish(LogEnd end);

    /// Records of jobs are missing between those that were taken.
    bool lacks_records() const { return lacks_records_; }

    /// As JobProgress.
    std::string commanded(const Run& run, Tick tick) const { return progress_.commanded(run, tick); }
    /// As EpochProgress.
    std::vector<Course> planned(const std::string& axis, Tick tick);

private:
    void handle(const OrderedRecord& record);
    void handle_first();
    void handle_turns();
    bool is_outdated(const RecordedJob& record);
    bool begin_epoch_of(const Run& run);
    bool is_left_out(const AxisRun& of) const;
    bool place(const AxisRun& of);
    void wait(AxisRun of);
    void place_waiting();
    void ask_epoch(const AxisRun& of, const std::string& why);
    void leave_out_before_first_job();

    Findings& findings_;
    FirstJob first_job_;
    EventCheck events_;
    OpenQuestions questions_{findings_};
    NewestEpochs epochs_;
    JobProgress progress_;
    RecordOrder records_;          // handled only when a run needs them: late runs of an ended epoch may come
    std::deque<AxisRun> waiting_;  // for the record of their epoch
    bool lacks_records_ = false;   // of jobs
};

}  // namespace lockstep::verification
