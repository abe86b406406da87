// lockstep timing apply
#include <memory>
#include <optional>

#include "clients/lockstep/live/timing_report.hpp"
#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/supervisor/edit_machine.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "services/documents/edit/timing_edit.hpp"

namespace lockstep {
namespace {

struct TimingOptions {
    std::string machine_file;
    double seconds = 60;
    std::optional<double> stall_ms;
    bool json = false;
};

doctor::StallFacts facts_of(const TimingOptions& options, std::int64_t slot_us, Output& output) {
    if (options.stall_ms) { return {.worst_us = *options.stall_ms * 1000}; }
    return watch_for_stalls(slot_us, options.seconds, output);
}

ExitCode apply(const TimingOptions& options) {
    Output output(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    const ProtocolTiming& today = machine->config.timing;
    const doctor::StallFacts facts = facts_of(options, today.slot_us, output);
    const ProtocolTiming proposed = doctor::timing_for(facts, today);
    const auto written = edit_machine(machine->file, [&](std::string_view text) { return with_slots(text, proposed); });
    if (!written) { return output.fail(written.error()); }
    print_timing(facts, proposed, today, output);
    output.print("written to " + machine->file.string() + "; give all hosts of the machine the same file");
    output.print("it applies after: lockstep down; lockstep up");
    proto::TimingReport report = timing_report(facts, proposed);
    report.set_file(machine->file.string());
    output.report(report);
    return kExitDone;
}

}  // namespace

void add_timing(Verb command) {
    const Verb verb = command.add_verb("timing",
                                       "write the fastest timing that the hosts can keep into the machine's file\n"
                                       "lockstep doctor --timing proposes this timing without writing it.");
    verb.footer(group_footer("  lockstep timing apply --machine mill.textproto --seconds 600\n", "timing apply"));
    const Verb part = verb.add_verb(
        "apply",
        "measure this host's stalls, and write the timing for stalls twice as long as the longest; the rest of the "
        "file does not change. Measure under the usual load; lockstep doctor --timing only shows the proposal");
    const auto options = std::make_shared<TimingOptions>();
    part.add_option("--machine", options->machine_file,
                    "the machine's configuration file; default: the file that other verbs use");
    part.add_option("--seconds", options->seconds, "for how long to measure stalls, s")
        .in_range(0.1, 86'400.0)
        .with_default();
    part.add_option(
            "--stall-ms", options->stall_ms,
            "instead of measuring: the longest stall of all hosts, as lockstep doctor --timing shows it on each")
        .in_range(0.0, 5'000.0);
    add_json(part, options->json);
    part.footer(
        footer("  lockstep timing apply --machine mill.textproto --seconds 600\n"
               "  lockstep timing apply --machine mill.textproto --stall-ms 4.5\n"));
    part.action([options] { return apply(*options); });
}

}  // namespace lockstep
