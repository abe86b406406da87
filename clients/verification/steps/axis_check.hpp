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
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "clients/verification/positions/position_check.hpp"
#include "clients/verification/positions/zero_check.hpp"
#include "clients/verification/process_order.hpp"
#include "clients/verification/steps/axis_findings.hpp"
#include "clients/verification/steps/clock_check.hpp"
#include "clients/verification/steps/compared_run.hpp"
#include "clients/verification/steps/ended_process.hpp"
#include "clients/verification/steps/log_beginning.hpp"
#include "clients/verification/steps/record_gaps.hpp"
#include "clients/verification/steps/waiting_steps.hpp"
#include "services/record/reading/positions/motor_zero.hpp"
#include "services/record/reading/step_stream.hpp"

namespace lockstep::verification {

/// Which part of an axis's record may lie outside the log.
struct LogEdges {
    bool begins_late = false;  // its process had published before the log began
    bool ends_early = false;   // it ends so soon after the newest steps and runs that related messages may be missing
    bool lacks_steps = false;  // by the marks, messages of steps after the last one are missing
    bool lacks_runs = false;   // likewise runs
    bool lacks_jobs = false;   // records of the machine's jobs are missing
};

class AxisCheck final : public analysis::StepListener {
public:
    /// Whether a process of the axis had ended by the end of the log.
    using HasEnded = std::function<bool(std::int64_t incarnation)>;
    /// The maximum number of steps that wait for the record of their run, which is written at the run's end.
    static constexpr std::size_t kMaxWaiting = 1 << 22;

    AxisCheck(std::string name, Findings& findings, AxisFindings::Commanded commanded, EndedProcess::Planned planned);
    /// `follower` must outlive this object.
    void set_follower(RunFollower& follower) { run_.set_follower(follower); }
    AxisCheck(const AxisCheck&) = delete;  // the stream calls this object
    AxisCheck& operator=(const AxisCheck&) = delete;

    void take(analysis::StepBatch batch) { stream_.take(std::move(batch)); }
    void take(const analysis::RecordedPosition& position);
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
    void began_before_log(const Run& run) { beginning_.take_before_log(run); }
    /// Call once, at the end of the log.
    void finish(const HasEnded& has_ended, LogEdges edges, const HomingJobs& homings = {});

    void on_batch(const analysis::StepBatch& batch) override;
    void on_break(const analysis::Break& what) override;
    void on_contradiction(const analysis::Contradiction& what) override;

private:
    void settle(bool log_ended);
    bool begin_next_run();
    bool is_of_older_process(const SeenStep& seen);
    bool is_left_at_end(const HasEnded& has_ended);
    void leave_steps();
    void end_of_log(LogEdges edges);

    AxisFindings findings_;
    ComparedRun run_;
    analysis::StepStream stream_{{this}};
    ClockCheck clocks_;
    analysis::MotorZero zero_;
    PositionCheck positions_{zero_};
    ZeroCheck zeros_{zero_};
    Ticks slot_{100'000};  // before the machine is known
    WaitingSteps waiting_;
    struct NextRun {
        Run run;
        bool is_behind_gap = false;  // runs before it are missing
    };
    std::deque<NextRun> runs_;
    bool runs_are_missing_ = false;  // before the next run to come
    bool device_lost_ = false;       // since the run before
    ProcessOrder processes_;
    LogBeginning beginning_;
    RecordGaps gaps_;
    EndedProcess ended_;
    std::map<std::int64_t, std::int64_t> marked_;  // by process: the first message of steps that must be in the log
};

}  // namespace lockstep::verification
