#include "clients/replay/replay.hpp"

#include <memory>
#include <optional>

#include "clients/replay/device_replay.hpp"
#include "clients/replay/replayed_log.hpp"
#include "clients/verification/log_check.hpp"
#include "clients/verification/verification.hpp"
#include "core/number_text.hpp"

namespace lockstep::replay {
namespace {

using analysis::LogPlace;

/// Passes the messages to the check, and all but steps and marks to the replay's own log.
class ReplayListener final : public analysis::LogListener {
public:
    explicit ReplayListener(RecordSink* made) {
        if (made != nullptr) { made_.emplace(*made); }
    }

    void on_steps(const step_batch_t& message, LogPlace place) override { check_.on_steps(message, place); }
    void on_position(const axis_position_t& message, LogPlace place) override {
        pass(message);
        check_.on_position(message, place);
    }
    void on_health(const axis_health_t& message, LogPlace /*place*/) override { pass(message); }
    void on_channel(const channel_event_t& message, LogPlace /*place*/) override { pass(message); }
    void on_job(const analysis::RecordedJob& message, LogPlace place) override {
        pass(message);
        check_.on_job(message, place);
    }
    void on_event(const program_event_t& message, LogPlace /*place*/) override { pass(message); }
    void on_run(const run_t& message, LogPlace place) override {
        ++runs_;
        pass(message);
        check_.on_run(message, place);
    }
    void on_program_part(const program_part_t& message, LogPlace /*place*/) override { pass(message); }
    void on_mark(const analysis::RecordedMark& message, LogPlace place) override { check_.on_mark(message, place); }
    void on_foreign(std::string_view /*channel*/) override {}
    void on_damage(LogPlace place, std::string what) override { check_.on_damage(place, std::move(what)); }

    Findings finish() {
        Findings findings = check_.finish();
        if (made_) { made_->finish(); }
        return findings;
    }

    /// In the log.
    std::int64_t runs() const { return runs_; }

private:
    void pass(const auto& message) {
        if (made_) { made_->take(message); }
    }
    std::unique_ptr<verification::RunFollower> make_device(const std::string& machine, const std::string& axis,
                                                           Findings& findings) {
        ReplayedSteps* steps = made_ ? &made_->steps(machine, axis) : nullptr;
        return std::make_unique<DeviceReplay>(axis, findings, [steps](const MadeStep& step) {
            if (steps != nullptr) { steps->take(step); }
        });
    }

    std::int64_t runs_ = 0;
    std::optional<ReplayedLog> made_;
    verification::LogCheck check_{[this](const std::string& machine, const std::string& axis, Findings& findings) {
        return make_device(machine, axis, findings);
    }};
};

}  // namespace

std::expected<Findings, std::string> replay_log(const std::filesystem::path& log, RecordSink* made,
                                                const std::function<void(double)>& progress) {
    ReplayListener listener(made);
    const auto events = analysis::read_log(log, listener, progress);
    if (!events) { return std::unexpected(events.error()); }
    Findings findings = listener.finish();
    if (listener.runs() == 0) { return std::unexpected(log.string() + ": it contains no run to replay"); }
    if (findings.runs == 0) {
        findings.add_unknown("none of its " + plural(listener.runs(), "run") +
                             " can be replayed: the log begins within a motion, and no motion begins from rest in it");
    }
    return findings;
}

proto::ReplayReport to_report(const Findings& findings, const std::string& log) {
    proto::ReplayReport report;
    report.set_exact(findings.verdict() == verification::Verdict::Exact);
    report.set_verdict(std::string(name_of(findings.verdict())));
    report.set_steps_replayed(findings.steps);
    report.set_runs_replayed(findings.runs);
    if (findings.difference) { verification::fill(*findings.difference, *report.mutable_first_difference()); }
    for (const std::string& line : findings.unknown) { report.add_unknown(line); }
    for (const std::string& note : findings.notes) { report.add_notes(note); }
    report.set_log(log);
    return report;
}

std::string to_text(const Findings& findings) {
    const std::string counted = plural(findings.steps, "step") + " of " + plural(findings.runs, "run");
    std::string text;
    if (findings.difference) {
        text = "not exact: " + findings.difference->text + "\n";
        if (!findings.difference->commanded.empty()) {
            text += "  in motion: " + findings.difference->commanded + "\n";
        }
        text += "  before that, the devices made as recorded: " + counted + "\n";
    } else if (findings.verdict() == verification::Verdict::Unknown) {
        text = "unknown: the log is incomplete; the devices made " + counted + " as recorded\n";
    } else {
        text = "exact: the devices made " + counted + " as recorded, tick for tick\n";
    }
    for (const std::string& line : findings.unknown) { text += "  unknown: " + line + "\n"; }
    for (const std::string& note : findings.notes) { text += "  note: " + note + "\n"; }
    return text;
}

}  // namespace lockstep::replay
