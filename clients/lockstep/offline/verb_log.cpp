// lockstep log
#include <fmt/format.h>

#include <algorithm>
#include <expected>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/merge/named_logs.hpp"
#include "clients/merge/report.hpp"
#include "clients/text/colour.hpp"
#include "clients/text/format.hpp"
#include "clients/text/output.hpp"
#include "services/record/new_log_file.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

struct LogMergeOptions {
    std::string out;
    std::vector<std::string> in;
    double window_s = static_cast<double>(merge::kWindow_us) * 1e-6;
    std::optional<double> since_s;
    std::optional<std::int64_t> job;
    bool all = false;
    bool force = false;
    bool json = false;
};

/// Why OUT may not be written, or empty. A likely mistake is to name only the logs and to forget OUT.
std::string obstacle(const LogMergeOptions& options, const std::vector<merge::GivenLog>& logs) {
    std::error_code error;
    const auto is_out = [&](const merge::GivenLog& log) { return fs::equivalent(log.path, options.out, error); };
    if (std::ranges::any_of(logs, is_out)) {
        return options.out + ": is one of the logs to merge; name a new file first: lockstep log merge OUT IN...";
    }
    if (!options.force && fs::exists(options.out, error)) {
        return options.out + ": exists already; name a new file, or add --force to replace it";
    }
    return "";
}

/// Fails if no log has the beginning of the job.
std::expected<merge::TimeSpan, std::string> span_of(const LogMergeOptions& options, const merge::ChosenLogs& chosen) {
    merge::TimeSpan span;
    if (options.job) {
        const auto its = merge::span_of_job(chosen.jobs, *options.job);
        if (!its) {
            return std::unexpected(fmt::format("no log has the beginning of job {}{}", *options.job,
                                               chosen.left_out.empty() ? "" : "; --all also searches other sessions"));
        }
        span = *its;
    }
    if (options.since_s) {
        const auto since_us = static_cast<std::int64_t>(*options.since_s * 1e6);
        span.from_us = std::max(span.from_us.value_or(since_us), since_us);
    }
    return span;
}

ExitCode merge_into(const LogMergeOptions& options, const merge::MergeOptions& what, merge::ChosenLogs chosen,
                    Output& output) {
    auto out = NewLogFile::begin(options.out, options.force);
    if (!out) { return output.fail(bad_input(out.error())); }
    auto merged = merge::merge_logs(what, out->sink());
    if (!merged) { return output.fail(bad_input(merged.error())); }
    merged->chosen = std::move(chosen);
    if (const auto kept = out->keep(); !kept) { return output.fail(bad_input(kept.error())); }
    std::string text = merge::to_text(*merged, options.out);
    text.pop_back();
    if (wants_colour()) {
        const std::size_t result = text.rfind('\n') + 1;
        text = text.substr(0, result) + painted(text.substr(result), merged->is_complete() ? kGood : kBad);
    }
    output.print(text);
    output.report(merge::to_report(*merged, options.out));
    return merged->is_complete() ? kExitDone : kExitFailed;
}

ExitCode log_merge(const LogMergeOptions& options) {
    Output output(options.json);
    const auto logs = merge::named_logs({options.in.begin(), options.in.end()});
    if (!logs) { return output.fail(bad_input(logs.error())); }
    if (const std::string why_not = obstacle(options, *logs); !why_not.empty()) {
        return output.fail(bad_input(why_not));
    }
    auto chosen = merge::choose_logs(*logs, options.all);
    if (!chosen) { return output.fail(bad_input(chosen.error())); }
    const auto span = span_of(options, *chosen);
    if (!span) { return output.fail(bad_input(span.error())); }
    merge::MergeOptions what{.logs = chosen->logs,
                             .span = *span,
                             .window_us = static_cast<std::int64_t>(options.window_s * 1e6),
                             .progress = {}};
    what.progress = [&](double done) { output.progress("merging " + fixed(done * 100, 0) + " %"); };
    return merge_into(options, what, std::move(*chosen), output);
}

void add_merge(Verb log) {
    const Verb verb =
        log.add_verb("merge", "combine several logs into one complete log, and report what none of them contains");
    const auto options = std::make_shared<LogMergeOptions>();
    verb.add_option("out", options->out, "the log to write").required();
    verb.add_option(
            "in", options->in,
            "the logs of lcm-logger, of the axes and of the coordinator; for a directory, all *.lcm files in it")
        .required();
    verb.add_option("--window", options->window_s,
                    "how many seconds a log may be out of order; a larger window needs more memory, up to 256 MB")
        .in_range(0.01, 600.0)
        .with_default();
    verb.add_option("--since", options->since_s, "merge only messages from this second of machine time on");
    verb.add_option(
        "--job", options->job,
        "merge only this job, the newest with this number: from the end of the job before it to the next job");
    verb.add_flag("--all", options->all, "also merge logs of earlier sessions in a directory");
    verb.add_flag("--force", options->force, "replace OUT if it exists");
    add_json(verb, options->json);
    verb.footer(
        "OUT has each message once, in the order of machine time. All messages are numbered, so messages that are\n"
        "in none of the logs are reported. Each process also records how much every process has published, so\n"
        "messages at the end and whole logs that are missing are reported too. If that cannot be known, the report\n"
        "says up to which time the record is complete.\n"
        "A directory may have logs of several sessions. Beside logs that are named as files, only the logs of their\n"
        "sessions are taken from it; otherwise only those of the newest session.\n" +
        footer("  lockstep log merge whole.lcm run.lcm /var/lib/lockstep/mill/record\n  lockstep verify whole.lcm\n"
               "  lockstep log merge job3.lcm /var/lib/lockstep/mill/record --job 3\n",
               "0 no message is known to be missing; 1 written, but messages are missing;\n"
               "2 bad usage, or a log cannot be read (nothing was written)"));
    verb.action([options] { return log_merge(*options); });
}

}  // namespace

void add_log(Verb command) {
    const Verb verb = command.add_verb("log", "combine logs: merge");
    verb.footer(group_footer("  lockstep log merge whole.lcm run.lcm /var/lib/lockstep/mill/record\n", "log merge"));
    add_merge(verb);
}

}  // namespace lockstep
