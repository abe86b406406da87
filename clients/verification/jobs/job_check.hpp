// Compares the runs of jobs with the frames that the coordinator's planning makes of their programs, bit for bit.
//
// Where records of jobs are missing, the rest of that job is not compared with its plan. Where runs of an axis are
// missing, its other runs still are.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clients/analysis/log/program_parts.hpp"
#include "clients/analysis/log/run.hpp"
#include "clients/verification/findings.hpp"
#include "clients/verification/jobs/epoch_check.hpp"
#include "clients/verification/jobs/event_check.hpp"
#include "clients/verification/jobs/job_replay.hpp"
#include "clients/verification/jobs/job_stream.hpp"
#include "clients/verification/jobs/open_questions.hpp"
#include "clients/verification/steps/left_steps.hpp"

namespace lockstep::verification {

using analysis::RecordedJob;
using analysis::Run;

class JobCheck {
public:
    /// The maximum number of runs that wait for the record of their epoch, which is written before they begin.
    static constexpr std::size_t kMaxWaiting = 4096;

    explicit JobCheck(Findings& findings) : findings_(findings), events_(findings) {}

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

    /// The motion at a tick of a run: "job 2, run plate.gcode, line 57, epoch 9, frame 12".
    std::string commanded(const Run& run, Tick tick) const;

    /// The runs that the plan allows an axis after its newest run, from a step at that tick on. Empty if there are
    /// none.
    std::vector<Course> planned(const std::string& axis, Tick tick);

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
    };
    struct Record : RecordedJob {
        bool is_behind_gap = false;
        bool is_of_event = false;  // no record of the job: it only marks the gap before an event
    };

    void handle(const Record& record);
    void lose_job(const Record& record);
    bool is_late(const RecordedJob& record) const;
    bool is_outdated(const RecordedJob& record);
    void note_owner(const RecordedJob& record);
    void begin(const Record& record);
    void begin_epoch(const RecordedJob& record);
    void turn(const RecordedJob& record);
    void handle_turns();
    void end(const RecordedJob& record);
    void close_epoch(bool goes_on, bool lacks_events);
    void lose_epoch();
    void leave_job_plan(Epoch epoch);
    void note_lost(Epoch epoch);
    void check_epoch(bool lacks_events);
    void check_events_so_far();
    void break_off(const Shortfall& shortfall);
    bool suspect(const Shortfall& shortfall);
    bool is_of_job(const RecordedJob& record) const;

    struct AxisRun {
        std::string axis;
        Run run;
        bool is_behind_gap = false;
    };
    bool place(const AxisRun& of);
    void compare(const AxisRun& of);
    void wait(AxisRun of);
    void ask_epoch(const AxisRun& of, const std::string& why);
    void plan_next(EpochReplay replay);
    void leave_job(const LogEnd& end);
    bool is_before_first_job(const Run& run) const;
    void leave_out_before_first_job();
    void leave_out(std::size_t runs);
    void note_beginning();
    void differ(std::string text, const std::string& axis = {}, const Run* run = nullptr);

    static constexpr std::size_t kLabelsKept = 16;

    Findings& findings_;
    EventCheck events_;
    std::deque<Record> records_;  // handled only when a run needs them: late runs of an ended epoch may come
    std::deque<AxisRun> waiting_;
    std::deque<std::pair<std::int64_t, std::int64_t>> begun_;  // the newest jobs: coordinator and number
    bool begins_late_ = false;
    std::size_t left_out_ = 0;  // runs of jobs that began before the log
    std::int64_t newest_event_job_ = 0;
    std::optional<std::int64_t> first_job_;  // the first with its beginning in the log
    std::optional<Epoch> first_epoch_;       // the first of such a job
    std::optional<Job> job_;
    std::optional<EpochCheck> epoch_;
    OpenQuestions questions_{findings_};
    std::deque<Epoch> lost_epochs_;                       // the newest whose plan is not known
    bool lacks_records_ = false;                          // of jobs
    std::deque<std::pair<Epoch, std::string>> labels_;    // of the newest epochs
    std::map<std::string, std::vector<Course>> planned_;  // by axis: what may follow its newest run
};

}  // namespace lockstep::verification
