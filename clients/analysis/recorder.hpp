// Collects the data of the whole machine: jobs and their moves, relations between axes, and errors.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clients/analysis/analysis.hpp"
#include "clients/analysis/measure/sorted_log.hpp"
#include "clients/analysis/measure/step_merge.hpp"
#include "clients/analysis/motors/axis_meter.hpp"
#include "clients/analysis/moves/move_meter.hpp"
#include "clients/analysis/power/power_logs.hpp"
#include "clients/analysis/sorter.hpp"
#include "services/record/reading/program_events.hpp"

namespace lockstep::analysis {

class Recorder final : public SortedListener {
public:
    /// `options` must outlive this object.
    explicit Recorder(const AnalysisOptions& options) : options_(options) {}
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    void on_axis(const std::string& name) override;
    void on_measured(std::size_t lane, const SharedSteps& steps) override;
    void on_position(const axis_position_t& message) override;
    void on_run(std::size_t lane, const Run& run) override;
    void on_job(const RecordedJob& message, LogPlace place) override;
    void on_event(const program_event_t& message, const ProgramEvent& event) override;
    void on_channel(const channel_event_t& message) override;
    void on_damage(LogPlace place, const std::string& what) override;
    void on_late(const std::string& axis, const SharedLate& steps) override;

    /// Call once, at the end of the log. Moves all results out, including the sorter's results for each axis.
    Analysis finish(Sorter& sorter);

private:
    struct Lane {
        std::string axis;
        LateFigures late;
        std::optional<std::int64_t> seen_us;  // time of its newest position or step
        std::int64_t incarnation = 0;         // process of its newest position
        std::int64_t sequence = 0;            // number of that position
    };

    JobLog* job(const job_t& message);
    std::size_t number_of(const JobLog& job) const { return static_cast<std::size_t>(&job - analysis_.jobs.data()); }
    void begin_job(const RecordedJob& message, JobLog& job, LogPlace place);
    void read_machine(const RecordedJob& message, LogPlace place);
    void note_unknown(JobLog& job, const std::vector<std::string>& motors, JobMoves& moves) const;
    void note_moves(JobLog& job, const JobMoves& moves);
    void note_move(JobLog& job, MoveLog move);

    const AnalysisOptions& options_;
    EventLog events_;
    ProgramEventLog program_events_;
    ChannelLog channels_;
    MoveMeter moves_{[this](std::size_t job, MoveMeter::Measured& measured) {
                         note_unknown(analysis_.jobs[job], measured.motors, measured.moves);
                         note_moves(analysis_.jobs[job], measured.moves);
                         measured.skew.add_to(analysis_.motor_skew);
                     },
                     options_.keeps_curves()};
    PowerLogs powers_;
    std::optional<AxisMeter> axes_;  // unless the motors are the axes
    std::string config_text_;        // of the configuration that was read last
    struct WaitingLate {
        std::string axis;
        SharedLate steps;
    };
    void settle();
    void settle_late(Tick end);

    StepMerge merge_;
    Tick newest_;  // machine time that the log has reached
    std::deque<WaitingLate> waiting_late_;
    std::vector<Lane> lanes_;  // by lane number
    Analysis analysis_;
    RecordedJob latest_program_;  // the job with the latest program
    std::size_t moves_kept_ = 0;
};

}  // namespace lockstep::analysis
