// Sorts a log's messages by axis and job.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "clients/analysis/analysis.hpp"
#include "clients/analysis/log_read.hpp"
#include "clients/analysis/move_meter.hpp"
#include "clients/analysis/skew.hpp"
#include "clients/analysis/step_merge.hpp"

namespace lockstep::analysis {

class Recorder final : public LogListener, private MeasuredListener {
public:
    explicit Recorder(const AnalysisOptions& options) : options_(options), machine_(options.machine) {}
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    void on_steps(const step_batch_t& message, LogPlace place) override;
    void on_position(const axis_position_t& message, LogPlace place) override;
    void on_health(const axis_health_t& message, LogPlace place) override;
    void on_run(const run_t& message, LogPlace place) override;
    void on_job(const job_t& message, LogPlace place) override;
    void on_foreign(std::string_view channel) override;
    void on_damage(LogPlace place, std::string what) override;

    /// The first file that could not be written, if any.
    const std::optional<std::string>& write_error() const { return write_error_; }
    /// Ends every axis and gives everything away.
    Analysis finish();

private:
    bool is_ours(const std::string& machine);
    AxisLog* axis(const std::string& machine, const std::string& name, LogPlace place);
    JobLog* job(const job_t& message);
    void begin_job(const job_t& message, JobLog& job, LogPlace place);
    std::optional<Program> read_documents(const job_t& message, LogPlace place);
    void on_measured(std::size_t lane, std::span<const MeasuredStep> steps, Ticks clock_error) override;
    void on_late(const std::string& axis, std::span<const LateStep> steps);
    bool is_during(Tick tick, const JobLog& job) const;
    void keep_asked_way(const Program& program);
    void note_moves(JobLog& job, const JobMoves& moves);
    void note_move(JobLog& job, MoveLog move);
    void note_error(const std::expected<void, std::string>& result);

    const AnalysisOptions& options_;
    std::optional<std::string> machine_;  // the one analysed: as asked, or the first heard
    EventLog events_;
    MoveMeter moves_{[this](std::size_t job, const JobMoves& moves) { note_moves(analysis_.jobs[job], moves); }};
    StepMerge merge_;
    SkewMeter skew_{[this](const std::string& axis, std::span<const LateStep> steps) { on_late(axis, steps); }};
    std::map<std::string, std::unique_ptr<AxisLog>> axes_;
    std::vector<std::string> lanes_;  // the axes by number, as they were first heard of
    Analysis analysis_;
    std::string latest_program_;
    std::size_t moves_kept_ = 0;
    std::size_t asked_points_ = 0;
    std::optional<std::string> write_error_;
};

}  // namespace lockstep::analysis
