// lockstep replay
#include <filesystem>
#include <memory>
#include <optional>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/offline/result_text.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/replay/replay.hpp"
#include "clients/text/output.hpp"
#include "services/record/new_log_file.hpp"

namespace lockstep {
namespace {

struct ReplayOptions {
    std::string log;
    std::string made;
    bool force = false;
    bool json = false;
};

ExitCode replay_verb(const ReplayOptions& options) {
    Output output(options.json);
    std::error_code ignored;
    if (std::filesystem::equivalent(options.log, options.made, ignored)) {
        return output.fail(bad_input(options.made + ": is the log that is replayed; name another file with --log"));
    }
    std::optional<NewLogFile> made;
    if (!options.made.empty()) {
        auto begun = NewLogFile::begin(options.made, options.force);
        if (!begun) { return output.fail(bad_input(begun.error())); }
        made.emplace(std::move(*begun));
    }
    const auto findings =
        replay::replay_log(options.log, made ? &made->sink() : nullptr, output.percent_on_terminal("replaying"));
    if (!findings) { return output.fail(bad_input(findings.error())); }
    if (made) {
        if (const auto kept = made->keep(); !kept) { return output.fail(failed(kept.error())); }
    }
    const bool exact = findings->verdict() == verification::Verdict::Exact;
    output.print(result_text(replay::to_text(*findings), exact));
    output.report(replay::to_report(*findings, options.made));
    return exact ? kExitDone : kExitFailed;
}

}  // namespace

void add_replay(Verb command) {
    const Verb verb = command.add_verb("replay",
                                       "run a log's frames on simulated devices and compare the steps\n"
                                       "The command compares every step with the log, tick for tick.");
    const auto options = std::make_shared<ReplayOptions>();
    verb.add_option("log", options->log, "an LCM log, of lcm-logger or of lockstep simulate").required();
    verb.add_option("--log", options->made, "write a log of the replay: the recorded messages with the new steps");
    verb.add_flag("--force", options->force, "replace the file of --log even if it is not a log");
    add_json(verb, options->json);
    verb.footer(
        "A replay writes the recorded frames into the registers of a device, as the axis did, and so proves\n"
        "that they make these steps. Where pulses stopped early, by a switch or a stop, the device is stopped\n"
        "at the recorded step. A replay does not plan the program again; lockstep verify does.\n" +
        footer("  lockstep replay plate.lcm\n"
               "  lockstep replay plate.lcm --log again.lcm && lockstep verify again.lcm\n",
               "0 exact; 1 not exact or unknown: the report has the first difference, or what the log lacks;\n"
               "2 bad usage, or no log with a run that can be replayed"));
    verb.action([options] { return replay_verb(*options); });
}

}  // namespace lockstep
