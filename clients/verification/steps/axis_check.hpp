// Compares one axis's steps with the steps that its runs make: each step must belong to a run, and each step of a run
// must exist. In the device's clock each step must be at its exact tick. If the device has its own clock, each step of
// a frame must also be at the commanded machine time, within the clocks' uncertainty.
//
// Where messages are missing, the comparison goes on behind them; what they contained is unknown.
//
// A process that ended unexpectedly may have left its last runs or steps unrecorded. The steps that it left are
// compared with the plan, if there is one, and reported in a note.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "clients/verification/findings.hpp"
#include "clients/verification/steps/clock_check.hpp"
#include "clients/verification/steps/left_steps.hpp"
#include "clients/verification/steps/position_check.hpp"
#include "clients/verification/steps/seen_step.hpp"
#include "clients/verification/steps/waiting_steps.hpp"
#include "services/record/reading/run.hpp"
#include "services/record/reading/step_stream.hpp"

namespace lockstep::verification {

using analysis::Run;
using analysis::StepMaker;

/// Receives the consistent part of the log, in order; counts the steps that it accepts.
class RunFollower {
public:
    virtual ~RunFollower() = default;
    virtual void on_run(const Run& run) = 0;
    /// A step of that run. `commanded`: in machine time. `is_recorded` is false if the log lacks the step: the process
    /// ended before publishing it, or the log begins later.
    virtual void on_step(StepEdge step, Tick commanded, bool is_recorded) = 0;
    virtual void on_run_over() = 0;
    /// Runs before the next one are not in the log.
    virtual void on_gap() = 0;
    /// The end of the log.
    virtual void on_end() = 0;
};

/// Which part of an axis's record may lie outside the log.
struct LogEdges {
    bool begins_late = false;  // its process had published before the log began
    bool ends_early = false;   // it ends so soon after the newest steps and runs that related messages may be missing
    bool lacks_steps = false;  // by the marks, messages of steps after the last one are missing
    bool lacks_runs = false;   // likewise runs
};

class AxisCheck final : public analysis::StepListener {
public:
    /// The motion at a tick of a run, as text.
    using Commanded = std::function<std::string(const Run&, Tick)>;
    /// The runs that the plan allows the axis after its newest run, from a step at that tick on; empty if there are
    /// none.
    using Planned = std::function<std::vector<Course>(Tick)>;
    /// Whether a process of the axis had ended by the end of the log.
    using HasEnded = std::function<bool(std::int64_t incarnation)>;
    /// The maximum number of steps that wait for the record of their run, which is written at the run's end.
    static constexpr std::size_t kMaxWaiting = 1 << 22;

    AxisCheck(std::string name, Findings& findings, Commanded commanded, Planned planned);
    /// `follower` must outlive this object.
    void set_follower(RunFollower& follower) { follower_ = &follower; }
    AxisCheck(const AxisCheck&) = delete;  // the stream calls this object
    AxisCheck& operator=(const AxisCheck&) = delete;

    void take(analysis::StepBatch batch) { stream_.take(std::move(batch)); }
    void take(const SeenPosition& position) { positions_.take(position); }
    /// The machine's file is known from its first job on.
    void set_machine(const MachineConfig& machine);
    /// Runs must come in the order of their numbers.
    void take(Run run);
    void runs_missing(std::int64_t from, std::int64_t end);
    /// The record has two different runs with this number.
    void runs_contradict(const Run& other);
    /// The axis has reported a lost device: the next run may be on a device that counts from 0.
    void device_lost() { device_lost_ = true; }
    /// Requires all messages of steps of that process from this number on to be in the log.
    void expect_from(std::int64_t incarnation, std::int64_t number) { marked_.try_emplace(incarnation, number); }
    /// Call it before take() for a run that began before the log: its first steps may be missing.
    void began_before_log(const Run& run);
    /// Call once, at the end of the log.
    void finish(const HasEnded& has_ended, LogEdges edges);

    void on_batch(const analysis::StepBatch& batch) override;
    void on_break(const analysis::Break& what) override;
    void on_contradiction(const analysis::Contradiction& what) override;

private:
    void settle(bool log_ended);
    bool begin_next_run();
    bool is_before_log(const Run& run) const;
    void leave_out_before_log(const Run& first);
    void pass_before_log();
    void end_run();
    void pass_step(bool is_recorded);
    bool is_cut_here(const SeenStep* seen);
    bool compare_equal();
    void note_equal(std::size_t steps);
    std::size_t in_time(const SeenBatch& batch, std::span<const StepEdge> steps);
    void differ_at(const SeenStep& seen);
    void pass_gap();
    void drop_steps_of_missing_runs();
    void note_gaps();
    void end_of_log(LogEdges edges);
    bool is_left_at_end(const HasEnded& has_ended);
    std::size_t birth_of(std::int64_t incarnation);
    bool is_of_older_process(const SeenStep& seen);
    bool is_of_newer_process(const SeenStep& seen);
    void leave_run();
    void leave_steps();
    void check_left(const std::vector<SeenStep>& left);
    void differ_from_plan(const std::string& what, const SeenStep& seen, const LeftSteps& found);
    void differ_unrecorded(std::int64_t steps);
    void differ(std::string text, std::optional<Tick> expected, std::optional<Tick> seen);
    std::string step_name() const;
    std::string waiting_text() const;
    void note_wrong(const std::optional<std::string>& why, std::optional<Tick> seen);
    std::string label() const { return findings_.label_of(name_); }

    std::string name_;
    Findings& findings_;
    Commanded commanded_;
    Planned planned_;
    RunFollower* follower_ = nullptr;
    analysis::StepStream stream_{{this}};
    ClockCheck clocks_;
    PositionCheck positions_;
    Ticks slot_{100'000};  // before the machine is known
    WaitingSteps waiting_;
    struct NextRun {
        Run run;
        bool is_behind_gap = false;  // runs before it are missing
    };
    std::deque<NextRun> runs_;
    std::vector<std::int64_t> incarnations_;  // in the order of their first messages
    std::optional<StepMaker> maker_;          // of the run being compared
    std::optional<Run> last_run_;             // the one before it
    bool device_lost_ = false;                // since last_run_
    // Where messages are missing.
    struct Gap {
        std::int64_t incarnation = 0;
        Tick from;  // of the device
        Tick until;
    };
    std::deque<Gap> steps_gaps_;                   // the steps between, exclusive, are not in the log
    std::optional<Gap> runs_gap_;                  // the steps up to `until` are of runs that are not in the log
    bool runs_are_missing_ = false;                // before the next run to come
    std::int64_t gap_steps_ = 0;                   // of recorded runs, not in the log
    std::int64_t gap_run_steps_ = 0;               // in the log, of runs that are not
    std::map<std::int64_t, std::int64_t> marked_;  // by process: the first message of steps that must be in the log
    // For a log that begins later than the process. Ticks are in the device's time.
    std::optional<std::pair<std::int64_t, std::int64_t>> before_log_;  // the last run before the log: process, number
    std::optional<std::pair<std::int64_t, Tick>> runs_from_;           // process and start of the first recorded run
    std::optional<Tick> steps_from_;                                   // the first recorded step
    std::int64_t before_log_steps_ = 0;                                // recorded steps of runs that are not recorded
    std::int64_t unrecorded_ = 0;                                      // steps that a process did not publish
    std::int64_t steps_ = 0;                                           // compared and equal
    std::optional<Tick> last_tick_;                                    // of the last of them
};

}  // namespace lockstep::verification
