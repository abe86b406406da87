// Passes each message of a log to the figures of the analysis and to the verification. So both read the same messages
// of the same machine, and the analysis grades the steps as the verification does.
#pragma once

#include "clients/analysis/log/log_read.hpp"
#include "clients/analysis/sorter.hpp"
#include "clients/verification/log_check.hpp"

namespace lockstep::analysis {

class JudgedLog final : public LogListener {
public:
    explicit JudgedLog(Sorter& sorter) : sorter_(sorter) {}

    void on_steps(const step_batch_t& message, LogPlace place) override {
        pass(&LogListener::on_steps, message, place);
    }
    void on_position(const axis_position_t& message, LogPlace place) override {
        pass(&LogListener::on_position, message, place);
    }
    void on_run(const run_t& message, LogPlace place) override { pass(&LogListener::on_run, message, place); }
    void on_job(const RecordedJob& message, LogPlace place) override { pass(&LogListener::on_job, message, place); }
    void on_health(const axis_health_t& message, LogPlace place) override {
        pass(&LogListener::on_health, message, place);
    }
    void on_event(const program_event_t& message, LogPlace place) override {
        pass(&LogListener::on_event, message, place);
    }
    void on_program_part(const program_part_t& message, LogPlace place) override {
        pass(&LogListener::on_program_part, message, place);
    }
    void on_mark(const record_mark_t& message, LogPlace place) override { pass(&LogListener::on_mark, message, place); }
    void on_foreign(std::string_view channel) override { sorter_.on_foreign(channel); }
    void on_damage(LogPlace place, std::string what) override { sorter_.on_damage(place, std::move(what)); }

    /// Call once, at the end of the log.
    verification::Findings finish() { return check_.finish(); }

private:
    template <typename Message>
    void pass(void (LogListener::*handler)(const Message&, LogPlace), const Message& message, LogPlace place) {
        (sorter_.*handler)(message, place);
        if (sorter_.machine() == message.machine) { (check_.*handler)(message, place); }
    }

    Sorter& sorter_;
    verification::LogCheck check_;
};

}  // namespace lockstep::analysis
