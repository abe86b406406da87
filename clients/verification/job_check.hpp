// Compares the runs of jobs with the frames that the coordinator's planning makes of their programs, bit for bit.
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
#include "clients/verification/epoch_replay.hpp"
#include "clients/verification/event_check.hpp"
#include "clients/verification/findings.hpp"
#include "clients/verification/job_replay.hpp"
#include "clients/verification/left_steps.hpp"

namespace lockstep::verification {

using analysis::RecordedJob;
using analysis::Run;

class JobCheck {
public:
    /// The maximum number of runs that wait for the record of their epoch, which is written before they begin.
    static constexpr std::size_t kMaxWaiting = 4096;

    /// Whether an axis's process had ended by the end of the log.
    using HasEnded = std::function<bool(const std::string& axis)>;

    explicit JobCheck(Findings& findings) : findings_(findings), events_(findings) {}

    void take(const RecordedJob& record);
    void take(const program_event_t& event);
    /// The log begins later than the record. A job that began before the log is not compared with its plan.
    void begins_late();
    /// A run of a job. The runs of each axis must come in the order of their numbers.
    void take(const std::string& axis, const Run& run);
    /// Call once, at the end of the log. `at_rest`: the log continues long enough after the last motion on record.
    void finish(bool at_rest, const HasEnded& has_ended);

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
        std::string broken;               // why the runs are not the whole plan; empty if they are
        std::string broken_axis;
    };
    struct Progress {  // of an axis in an epoch
        FrameNumber ran = 0;
        bool in_tail = false;
        bool cut = false;
        Position at;
        std::optional<Tick> end;  // of its last run
    };
    struct EpochCheck {
        EpochReplay replay;
        std::vector<Progress> axes;
    };

    bool has_own_clocks() const { return job_->replay->machine().timing.time_source == TimeSource::Network; }
    /// The largest clock error with which an axis moves.
    Ticks known_within() const { return has_own_clocks() ? job_->replay->machine().clock_error_limit() : Ticks{}; }
    void handle(const RecordedJob& record);
    bool is_late(const RecordedJob& record) const;
    bool is_outdated(const RecordedJob& record);
    void note_owner(const RecordedJob& record);
    void begin(const RecordedJob& record);
    void begin_epoch(const RecordedJob& record);
    void turn(const RecordedJob& record);
    void handle_turns();
    void end(const RecordedJob& record);
    void close_epoch(bool lacks_events = false);
    void check_epoch(bool lacks_events);
    void check_events_so_far();
    void break_off(std::size_t axis, const std::string& why);
    bool breaks_off(std::size_t axis);
    bool is_of_job(const RecordedJob& record) const;

    bool place(const std::string& axis, const Run& run);
    void compare(std::size_t axis, const std::string& name, const Run& run);
    void plan_next(EpochReplay replay);
    std::vector<Course> courses_of(EpochReplay& replay, std::size_t axis) const;
    void leave_job(const HasEnded& has_ended);
    std::string out_of_order(const Progress& axis, const Run& run) const;
    bool is_before_first_job(const Run& run) const;
    void leave_out_before_first_job();
    void leave_out(std::size_t runs);
    void note_beginning();
    void differ(std::string text, const std::string& axis = {}, const Run* run = nullptr);

    static constexpr std::size_t kLabelsKept = 16;

    Findings& findings_;
    EventCheck events_;
    std::deque<RecordedJob> records_;  // handled only when a run needs them: late runs of an ended epoch may come
    std::deque<std::pair<std::string, Run>> waiting_;
    std::deque<std::pair<std::int64_t, std::int64_t>> begun_;  // the newest jobs: coordinator and number
    bool begins_late_ = false;
    std::size_t left_out_ = 0;  // runs of jobs that began before the log
    std::int64_t newest_event_job_ = 0;
    std::optional<std::int64_t> first_job_;  // the first with its beginning in the log
    std::optional<Epoch> first_epoch_;       // the first of such a job
    std::optional<Job> job_;
    std::optional<EpochCheck> epoch_;
    std::deque<std::pair<Epoch, std::string>> labels_;    // of the newest epochs
    std::map<std::string, std::vector<Course>> planned_;  // by axis: what may follow its newest run
};

}  // namespace lockstep::verification
