#include "clients/verification/verification.hpp"

#include <fmt/format.h>

#include "clients/verification/log_check.hpp"
#include "core/number_text.hpp"

namespace lockstep::verification {

std::string_view name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::Exact: return "exact";
        case Verdict::Unknown: return "unknown";
        case Verdict::NotExact: return "not exact";
    }
    return "";
}

namespace {

std::string counted(const Findings& findings) {
    return plural(findings.steps, "step") + ", " + plural(findings.runs + findings.local_runs, "run") + " and " +
           plural(findings.jobs, "job") + (findings.events > 0 ? ", with " + plural(findings.events, "event") : "") +
           (findings.outputs > 0
                ? (findings.events > 0 ? " and " : ", with ") + plural(findings.outputs, "output change")
                : "") +
           (findings.events + findings.outputs > 0 ? "," : "");
}

}  // namespace

std::expected<Findings, std::string> verify_log(const std::filesystem::path& log,
                                                const std::function<void(double)>& progress) {
    LogCheck check;
    const auto events = analysis::read_log(log, check, progress);
    if (!events) { return std::unexpected(events.error()); }
    Findings findings = check.finish();
    if (findings.unreadable) { return std::unexpected(log.string() + ": " + *findings.unreadable); }
    if (findings.going() && findings.steps + findings.runs + findings.local_runs + findings.jobs == 0) {
        return std::unexpected(log.string() + ": it contains no step, run or job to verify");
    }
    return findings;
}

void fill(const Difference& difference, proto::Difference& out) {
    out.set_text(difference.text);
    out.set_axis(difference.axis);
    out.set_commanded(difference.commanded);
    if (difference.tick_expected) { out.set_tick_expected(difference.tick_expected->value); }
    if (difference.tick_seen) { out.set_tick_seen(difference.tick_seen->value); }
}

proto::VerifyReport to_report(const Findings& findings) {
    proto::VerifyReport report;
    report.set_exact(findings.is_exact());
    report.set_verdict(std::string(name_of(findings.verdict())));
    report.set_steps_compared(findings.steps);
    report.set_runs_compared(findings.runs + findings.local_runs);
    report.set_jobs_compared(findings.jobs);
    report.set_events_compared(findings.events);
    report.set_outputs_compared(findings.outputs);
    if (findings.difference) { fill(*findings.difference, *report.mutable_first_difference()); }
    for (const std::string& note : findings.notes) { report.add_notes(note); }
    for (const std::string& line : analysis::missing_sentences(findings.end)) { report.add_missing_at_end(line); }
    for (const std::string& line : findings.unknown) { report.add_missing_at_end(line); }
    return report;
}

std::string to_text(const Findings& findings) {
    std::string text;
    if (findings.difference) {
        text = "not exact: " + findings.difference->text + "\n";
        if (!findings.difference->commanded.empty()) {
            text += "  in motion: " + findings.difference->commanded + "\n";
        }
        text += "  compared before that and equal: " + counted(findings) + "\n";
    } else if (findings.verdict() == Verdict::Unknown) {
        text = "unknown: the log is incomplete; its content is what the programs give: " + counted(findings) + "\n";
    } else {
        text = "exact: " + counted(findings) + " are what the programs give, tick for tick\n";
    }
    for (const std::string& line : findings.unknown) { text += "  unknown: " + line + "\n"; }
    for (const std::string& line : analysis::missing_sentences(findings.end)) { text += "  missing: " + line + "\n"; }
    if (findings.more_unknown > 0) {
        text += fmt::format("  unknown: and {} more such places\n", findings.more_unknown);
    }
    if (findings.lacks_messages || !findings.end.missing.empty()) {
        text += fmt::format("  note: {}\n", analysis::kWhereTheRestIs);
    }
    for (const std::string& note : findings.notes) { text += "  note: " + note + "\n"; }
    return text;
}

}  // namespace lockstep::verification
