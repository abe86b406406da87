// One axis's steps against the steps that its runs make: each step is of a run, each step of a run is there. By the
// device's clock each is at its very tick; where that clock is its own, each step of a frame is also at the machine
// time commanded, within what the clocks were known to.
//
// A process that ended unasked may have left the record of its last runs unwritten, or its last steps. What it left is
// held to the plan as far as there is one, and said in a note.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clients/analysis/log/run.hpp"
#include "clients/analysis/log/step_stream.hpp"
#include "clients/verification/findings.hpp"
#include "clients/verification/left_steps.hpp"
#include "clients/verification/seen_step.hpp"

namespace lockstep::verification {

using analysis::Run;
using analysis::StepMaker;

/// Hears what the log is found to agree on with itself, in its order; it counts the steps that it finds good.
class RunFollower {
public:
    virtual ~RunFollower() = default;
    virtual void on_run(const Run& run) = 0;
    /// A step of that run. `commanded`: in machine time. Not recorded: the process ended before it said so.
    virtual void on_step(StepEdge step, Tick commanded, bool is_recorded) = 0;
    virtual void on_run_over() = 0;
    /// The end of the log.
    virtual void on_end() = 0;
};

/// What of an axis's record may lie outside the log.
struct LogEdges {
    bool begins_late = false;  // its process had published before
    bool ends_early = false;   // it ends so soon behind the newest steps and runs that what belongs to them may follow
};

class AxisCheck final : public analysis::StepListener {
public:
    /// What was in motion at a tick of a run, in words.
    using Commanded = std::function<std::string(const Run&, Tick)>;
    /// What the plan allows the axis to have run behind its newest run, from a step at that tick on. Empty: nothing.
    using Planned = std::function<std::vector<Course>(Tick)>;
    /// Whether a process of the axis had ended by the end of the log.
    using HasEnded = std::function<bool(std::int64_t incarnation)>;
    /// So many steps may wait for the record of their run, which is written when it has ended.
    static constexpr std::size_t kMaxWaiting = 1 << 22;

    AxisCheck(std::string name, Findings& findings, Commanded commanded, Planned planned);
    /// It outlives the check.
    void tell(RunFollower& follower) { follower_ = &follower; }
    AxisCheck(const AxisCheck&) = delete;  // the stream tells its steps to this object
    AxisCheck& operator=(const AxisCheck&) = delete;

    void take(analysis::StepBatch batch) { stream_.take(std::move(batch)); }
    /// In the order of their numbers.
    void take(Run run);
    void runs_missing(std::int64_t from, std::int64_t end);
    /// The axis has said so: the next run may be on a device that counts anew.
    void device_lost() { device_lost_ = true; }
    /// From now on all messages of steps of that process from this number on are in the log.
    void expect_from(std::int64_t incarnation, std::int64_t number) { marked_.try_emplace(incarnation, number); }
    /// A run that had begun before the log did: its first steps may not be there. Before it is taken.
    void began_before_log(const Run& run);
    /// Call once, at the end of the log.
    void finish(const HasEnded& has_ended, LogEdges edges);

    void on_batch(const analysis::StepBatch& batch) override;
    void on_break(const analysis::Break& what) override;

private:
    void settle(bool log_ended);
    bool begin_next_run();
    bool is_before_log(const Run& run) const;
    bool is_before_log(const SeenStep& seen) const;
    void leave_out_before_log(const Run& first);
    void pass_before_log();
    void end_run();
    void pass_step(bool is_recorded);
    bool is_cut_here(const SeenStep* seen);
    void compare(const SeenStep& seen);
    void compare_time(const SeenStep& seen, const std::string& step);
    void end_of_log(LogEdges edges);
    bool is_left_at_end(const HasEnded& has_ended);
    std::size_t birth_of(std::int64_t incarnation);
    bool is_of_older_process(const SeenStep& seen);
    bool is_of_newer_process(const SeenStep& seen);
    void leave_run();
    void leave_steps();
    void judge(const std::vector<SeenStep>& left);
    void differ_from_plan(const std::string& what, const SeenStep& seen, const LeftSteps& found);
    void differ_unsaid(std::int64_t steps);
    void differ(std::string text, std::optional<Tick> expected, std::optional<Tick> seen);
    std::string step_name() const;

    std::string name_;
    Findings& findings_;
    Commanded commanded_;
    Planned planned_;
    RunFollower* follower_ = nullptr;
    analysis::StepStream stream_{{this}};
    std::deque<SeenStep> waiting_;
    std::deque<Run> runs_;
    std::vector<std::int64_t> incarnations_;       // in the order of their first messages
    std::optional<StepMaker> maker_;               // of the run being compared
    std::optional<Run> last_run_;                  // the one before it
    bool device_lost_ = false;                     // since the run before it
    std::map<std::int64_t, std::int64_t> marked_;  // by process: the first message of steps that must be there
    // Where the log begins later than the process: device's time, and both of that process.
    std::optional<std::pair<std::int64_t, std::int64_t>> before_log_;  // the last run begun before it: process, number
    std::optional<std::pair<std::int64_t, Tick>> runs_from_;           // the start of the first run on record
    std::optional<Tick> steps_from_;                                   // the first step on record
    std::int64_t before_log_steps_ = 0;                                // on record, of runs that are not
    std::int64_t unsaid_ = 0;                                          // steps that a process which ended had not said
    std::int64_t steps_ = 0;                                           // compared and equal
    std::optional<Tick> last_tick_;                                    // of these
};

}  // namespace lockstep::verification
