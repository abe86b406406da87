// lockstep probe
#include "clients/lockstep/job/job.hpp"
#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/session/job_plan.hpp"
#include "clients/session/move_program.hpp"
#include "clients/supervisor/machine_choice.hpp"

namespace lockstep {
namespace {

struct ProbeVerbOptions : LiveOptions {
    ProbeOptions probe;
};

ExitCode probe(const ProbeVerbOptions& options) {
    Output output(options.json);
    if (options.probe.move.targets.empty()) {
        return output.fail(bad_input("name where the move ends, such as Z=-10; see: lockstep probe --help"));
    }
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    auto session = Session::open(*machine, Purpose::Command);
    if (!session) { return output.fail(session.error()); }
    const auto start_mm = start_places(*session);
    if (!start_mm) { return output.fail(start_mm.error()); }
    auto program = probe_program(machine->config, *start_mm, options.probe);
    if (!program) { return output.fail(bad_input(program.error())); }
    const Job job{.command = CommandKind::Run,
                  .kind = "probe",
                  .name = "probe",
                  .program = *std::move(program),
                  .probes = true,
                  .take = options.take};
    return run_job(*session, job, output);
}

}  // namespace

void add_probe(Verb command) {
    const Verb verb =
        command.add_verb("probe",
                         "move until a probe touches, and print where every axis was at the touch\n"
                         "The axes move in a straight line and come to rest behind the touch. The verbs below touch "
                         "several times, and compute what they measure.");
    const auto options = std::make_shared<ProbeVerbOptions>();
    verb.add_option("targets", options->probe.move.targets,
                    "AXIS=MM, e.g. Z=-10: where the move ends without a touch; axes that are not named do not move");
    verb.add_option("--feed", options->probe.move.feed_mm_min, "speed along the line, mm/min; needed");
    verb.add_flag("--relative", options->probe.move.relative,
                  "targets are distances from each axis's present position");
    verb.add_option("--probe", options->probe.probe, "the probe's number; default: the machine's only one")
        .in_range(0, 63);
    verb.add_flag("--away", options->probe.away, "the probe touches now; move until it no longer does");
    verb.add_flag("--may-miss", options->probe.may_miss, "succeed without a touch, too");
    add_take(verb, *options);
    add_live_options(verb, *options);
    verb.footer(kInterrupted + footer("  lockstep probe Z=-10 --feed 60\n  lockstep probe Z=-10 --relative --feed 60\n"
                                      "  lockstep probe Z=2 --relative --feed 30 --away\n"));
    verb.action([options] { return probe(*options); });
    add_measurements(verb);
}

}  // namespace lockstep
