// Passes each message of a log to the figures of the analysis and to the verification. So both read the same messages
// of the same machine, and the analysis grades the steps as the verification does. The verification has its own thread.
#pragma once

#include <memory>
#include <utility>

#include "clients/analysis/sorter.hpp"
#include "clients/analysis/stages/work_thread.hpp"
#include "clients/verification/log_check.hpp"
#include "services/record/reading/log_read.hpp"

namespace lockstep::analysis {

class JudgedLog final : public LogListener {
public:
    explicit JudgedLog(Sorter& sorter) : sorter_(sorter) {}

    void on_steps(const step_batch_t& message, LogPlace place) override {
        take(std::make_shared<const StepMessage>(to_step_message(message)), place);
    }
    void on_position(const axis_position_t& message, LogPlace place) override {
        pass(&LogListener::on_position, message, place);
    }
    void on_run(const run_t& message, LogPlace place) override {
        take(std::make_shared<const RunMessage>(to_run_message(message)), place);
    }
    void on_job(const RecordedJob& message, LogPlace place) override { pass(&LogListener::on_job, message, place); }
    void on_health(const axis_health_t& message, LogPlace place) override {
        pass(&LogListener::on_health, message, place);
    }
    void on_event(const program_event_t& message, LogPlace place) override {
        pass(&LogListener::on_event, message, place);
    }
    void on_channel(const channel_event_t& message, LogPlace place) override {
        pass(&LogListener::on_channel, message, place);
    }
    void on_program_part(const program_part_t& message, LogPlace place) override {
        pass(&LogListener::on_program_part, message, place);
    }
    void on_mark(const RecordedMark& message, LogPlace place) override { pass(&LogListener::on_mark, message, place); }
    void on_foreign(std::string_view channel) override { sorter_.on_foreign(channel); }
    void on_damage(LogPlace place, std::string what) override { sorter_.on_damage(place, std::move(what)); }

    /// Call once, at the end of the log.
    verification::Findings finish() {
        checking_.finish();
        return check_.finish();
    }

private:
    template <typename Message>
    void pass(void (LogListener::*handler)(const Message&, LogPlace), const Message& message, LogPlace place) {
        (sorter_.*handler)(message, place);
        if (sorter_.machine() != message.machine) { return; }
        checking_.add([this, handler, message, place] { (check_.*handler)(message, place); });
    }
    /// Both read the same converted message.
    template <typename Message>
    void take(std::shared_ptr<const Message> message, LogPlace place) {
        sorter_.take(*message, place);
        if (sorter_.machine() != message->machine) { return; }
        checking_.add([this, message = std::move(message), place] { check_.take(*message, place); });
    }

    Sorter& sorter_;
    verification::LogCheck check_;
    WorkThread checking_;
};

}  // namespace lockstep::analysis
