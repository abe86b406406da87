// Sorts a log's messages by machine and axis. Measures the figures of each single axis, and passes on messages that
// concern several axes or jobs.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "clients/analysis/analysis.hpp"
#include "clients/analysis/measure/sorted_log.hpp"
#include "core/machine.hpp"
#include "services/record/reading/log_read.hpp"
#include "services/record/reading/log_step.hpp"
#include "services/record/reading/message_numbers.hpp"
#include "services/record/reading/record_end.hpp"

namespace lockstep::analysis {

class Sorter final : public LogListener {
public:
    Sorter(const AnalysisOptions& options, SortedListener& listener)
        : options_(options), listener_(listener), machine_(options.machine) {}
    Sorter(const Sorter&) = delete;
    Sorter& operator=(const Sorter&) = delete;

    void on_steps(const step_batch_t& message, LogPlace place) override { take(to_step_message(message), place); }
    void take(const StepMessage& message, LogPlace place);
    void on_position(const axis_position_t& message, LogPlace place) override;
    void on_health(const axis_health_t& message, LogPlace place) override;
    void on_run(const run_t& message, LogPlace place) override { take(to_run_message(message), place); }
    void take(const RunMessage& message, LogPlace place);
    void on_job(const RecordedJob& message, LogPlace place) override;
    void on_event(const program_event_t& message, LogPlace place) override;
    void on_channel(const channel_event_t& message, LogPlace place) override;
    void on_program_part(const program_part_t& message, LogPlace place) override;
    void on_mark(const RecordedMark& message, LogPlace place) override;
    void on_foreign(std::string_view channel) override;
    void on_damage(LogPlace place, std::string what) override;

    /// The analyzed machine; nullopt before its first message.
    const std::optional<std::string>& machine() const { return machine_; }
    /// Delivers the waiting steps. Call once, at the end of the log. The error is that of the first file that could not
    /// be written.
    std::expected<void, std::string> finish();
    /// Moves the axes, in the order of their names, and the counts into `analysis`.
    void give(Analysis& analysis);

private:
    struct Lane {
        std::size_t number = 0;
        std::unique_ptr<AxisLog> log;
    };

    bool is_ours(const std::string& machine);
    Lane* lane(const std::string& machine, const std::string& axis, LogPlace place);
    void set_config(const std::string& text);
    void note_error(const std::expected<void, std::string>& result);

    const AnalysisOptions& options_;
    SortedListener& listener_;
    std::optional<std::string> machine_;   // the analyzed machine: as chosen, or the first received
    std::optional<MachineConfig> config_;  // of its first job in the log
    std::map<std::string, Lane> lanes_;
    std::map<std::string, std::uint64_t> foreign_;
    std::uint64_t runs_ = 0;
    MessageNumbers job_numbers_;
    RecordEndCheck end_;
    std::optional<std::string> write_error_;
};

}  // namespace lockstep::analysis
