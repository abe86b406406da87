// lockstep log
#include <algorithm>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

#include "clients/lockstep/colour.hpp"
#include "clients/lockstep/live/live_options.hpp"
#include "clients/lockstep/live/voice.hpp"
#include "clients/lockstep/live/words.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/merge/named_logs.hpp"
#include "clients/merge/report.hpp"
#include "services/record/new_log_file.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

struct LogMergeOptions {
    std::string out;
    std::vector<std::string> in;
    double window_s = static_cast<double>(merge::kWindow_us) * 1e-6;
    bool force = false;
    bool json = false;
};

/// Empty: OUT may be written. The mistake to expect is to name the logs and forget OUT.
std::string obstacle(const LogMergeOptions& options, const std::vector<fs::path>& logs) {
    std::error_code error;
    const auto is_out = [&](const fs::path& log) { return fs::equivalent(log, options.out, error); };
    if (std::ranges::any_of(logs, is_out)) {
        return options.out + ": is one of the logs to merge; name a new file first: lockstep log merge OUT IN...";
    }
    if (!options.force && fs::exists(options.out, error)) {
        return options.out + ": is there already; name a new file, or say --force to replace it";
    }
    return "";
}

ExitCode merge_into(const LogMergeOptions& options, const merge::MergeOptions& what, Voice& voice) {
    auto out = NewLogFile::begin(options.out, options.force);
    if (!out) { return voice.fail(bad_input(out.error())); }
    const auto merged = merge::merge_logs(what, out->sink());
    if (!merged) { return voice.fail(bad_input(merged.error())); }
    if (const auto kept = out->keep(); !kept) { return voice.fail(bad_input(kept.error())); }
    std::string text = merge::to_text(*merged, options.out);
    text.pop_back();
    if (wants_colour()) {
        const std::size_t verdict = text.rfind('\n') + 1;
        text = text.substr(0, verdict) + painted(text.substr(verdict), merged->is_complete() ? kGood : kBad);
    }
    voice.say(text);
    voice.report(merge::to_report(*merged, options.out));
    return merged->is_complete() ? kExitDone : kExitFailed;
}

ExitCode log_merge(const LogMergeOptions& options) {
    Voice voice(options.json);
    const auto logs = merge::named_logs({options.in.begin(), options.in.end()});
    if (!logs) { return voice.fail(bad_input(logs.error())); }
    if (const std::string why_not = obstacle(options, *logs); !why_not.empty()) {
        return voice.fail(bad_input(why_not));
    }
    merge::MergeOptions what{
        .logs = *logs, .window_us = static_cast<std::int64_t>(options.window_s * 1e6), .progress = {}};
    what.progress = [&](double done) { voice.progress("merging " + fixed(done * 100, 0) + " %"); };
    return merge_into(options, what, voice);
}

void add_merge(CLI::App& log, Action& action) {
    CLI::App* verb = log.add_subcommand("merge", "make one complete log of several, and say what none of them has");
    const auto options = std::make_shared<LogMergeOptions>();
    verb->add_option("out", options->out, "the log to write")->required();
    verb->add_option("in", options->in,
                     "the logs: of lcm-logger, of axes and coordinator; a directory: all *.lcm in it")
        ->required();
    verb->add_option("--window", options->window_s,
                     "seconds by which a log may be out of order; more takes more memory, up to 256 MB")
        ->check(CLI::Range(0.01, 600.0))
        ->capture_default_str();
    verb->add_flag("--force", options->force, "replace OUT where it is there");
    verb->add_flag("--json", options->json, "one JSON report on standard output instead of text");
    verb->footer(
        "Example:\n"
        "  lockstep log merge whole.lcm run.lcm /var/lib/lockstep/mill/record\n"
        "  lockstep verify whole.lcm\n\n"
        "Messages come in the order of machine time, each once. Steps and runs are numbered: what is in none of the\n"
        "logs is said, from step and tick to step and tick. Positions, figures and jobs have no numbers; and nothing\n"
        "in a log tells of what came after its last message.\n\n"
        "Exit codes: 0 complete, 1 written but steps or runs are missing, 2 bad usage or a log that cannot be read:\n"
        "nothing is written\n");
    verb->callback([&action, options] { action = [options] { return log_merge(*options); }; });
}

}  // namespace

void add_log(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand("log", "work with logs: merge");
    verb->require_subcommand(1);
    verb->footer(
        "Example:\n  lockstep log merge whole.lcm run.lcm /var/lib/lockstep/mill/record\n\n"
        "Options: lockstep log merge --help");
    add_merge(*verb, action);
}

}  // namespace lockstep
