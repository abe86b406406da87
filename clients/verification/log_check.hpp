// Passes a log's messages to the comparisons: steps and runs by axis, jobs by machine.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "clients/verification/activity.hpp"
#include "clients/verification/events/touch_check.hpp"
#include "clients/verification/jobs/job_check.hpp"
#include "clients/verification/steps/axis_check.hpp"
#include "clients/verification/steps/output_check.hpp"
#include "clients/verification/steps/run_stream.hpp"
#include "services/record/reading/log_read.hpp"
#include "services/record/reading/log_step.hpp"
#include "services/record/reading/message_numbers.hpp"

namespace lockstep::verification {

class LogCheck final : public analysis::LogListener {
public:
    /// Creates the follower of an axis's runs.
    using MakeFollower =
        std::function<std::unique_ptr<RunFollower>(const std::string& machine, const std::string& axis, Findings&)>;

    /// Compares steps with runs, and runs with plans.
    LogCheck() = default;
    /// Compares steps with runs, which are accepted as recorded; the follower checks the runs.
    explicit LogCheck(MakeFollower make_follower) : make_follower_(std::move(make_follower)) {}

    void on_steps(const step_batch_t& message, analysis::LogPlace place) override {
        take(analysis::to_step_message(message), place);
    }
    void take(const analysis::StepMessage& message, analysis::LogPlace place);
    void on_position(const axis_position_t& message, analysis::LogPlace place) override;
    void on_run(const run_t& message, analysis::LogPlace place) override {
        take(analysis::to_run_message(message), place);
    }
    void take(const analysis::RunMessage& message, analysis::LogPlace place);
    void on_job(const analysis::RecordedJob& message, analysis::LogPlace place) override;
    void on_event(const program_event_t& message, analysis::LogPlace place) override;
    void on_health(const axis_health_t& message, analysis::LogPlace place) override;
    void on_channel(const channel_event_t& message, analysis::LogPlace place) override;
    void on_program_part(const program_part_t& message, analysis::LogPlace place) override;
    void on_mark(const analysis::RecordedMark& message, analysis::LogPlace place) override;
    void on_foreign(std::string_view /*channel*/) override {}
    void on_damage(analysis::LogPlace place, std::string what) override;

    Findings finish();

private:
    static constexpr std::size_t kMaxMachines = 64;
    static constexpr std::size_t kDamagesNoted = 5;

    /// The maximum delay of a process between noting and publishing.
    static constexpr std::int64_t kStall_us = 100'000;

    struct Axis {
        Axis(const std::string& name, Findings& findings, JobCheck* jobs);
        /// Call it for each of the axis's messages, with the time at which it was published. `is_its_first`: the
        /// message is the first of its kind.
        void begin(std::int64_t utime, bool is_its_first);
        bool began_before_log(const analysis::RunMessage& message) const;
        std::optional<std::int64_t> first_us;  // when the axis was first received
        bool is_late = true;                   // the log lacks its first messages
        AxisActivity last;
        bool has_run = false;
        bool is_behind_gap = false;  // runs before the next one are missing
        std::unique_ptr<RunFollower> follower;
        AxisCheck check;
        OutputCheck outputs;
        RunStream runs;
    };
    struct Machine {
        explicit Machine(Findings& findings);
        bool has_ended(const std::string& axis) const;
        void note_message(Axis& axis, std::int64_t incarnation, std::int64_t utime);
        void note_motion(Axis& axis);
        bool are_at_rest() const;
        void finish(const std::string& name, const analysis::RecordEnd& end, bool is_damaged);
        void set_config(const std::string& text, Findings& findings);
        void check_axes(Findings& findings) const;
        TouchCheck touches;
        HomingJobs homings;
        JobCheck jobs;
        JobStream records;
        std::optional<MachineConfig> config;  // of its first job in the log
        MachineActivity last;
        std::map<std::string, std::unique_ptr<Axis>> axes;
        std::map<std::int64_t, std::int64_t> marked_jobs;  // by coordinator: the first event that must be in the log
        std::set<std::string> marked_axes;                 // that marks name
        bool has_jobs = false;
    };
    void check_place(const axis_position_t& message, const Machine& of);
    void take_record(const auto& message, RecordKind kind, analysis::LogPlace place);
    void note_beginning(Machine& machine, std::int64_t coordinator, std::int64_t sequence, std::int64_t job);

    Machine* machine(const std::string& name, analysis::LogPlace place);
    Axis* axis(const std::string& machine, const std::string& name, analysis::LogPlace place);

    MakeFollower make_follower_;
    Findings findings_;
    std::map<std::string, Machine> machines_;
    analysis::RecordEndCheck end_;
    std::size_t damages_ = 0;
};

}  // namespace lockstep::verification
