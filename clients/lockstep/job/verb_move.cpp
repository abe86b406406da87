// lockstep move
#include "clients/lockstep/job/job.hpp"
#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/session/job_plan.hpp"
#include "clients/session/move_program.hpp"
#include "clients/supervisor/machine_choice.hpp"

namespace lockstep {
namespace {

struct MoveVerbOptions : LiveOptions {
    MoveOptions move;
    bool detach = false;
};

ExitCode move_together(Session& session, const Program& program, const std::vector<double>& start_mm,
                       const MoveVerbOptions& options, Output& output) {
    const auto planned_s = planned_seconds(session, program, start_mm);
    if (!planned_s) { return output.fail(planned_s.error()); }
    const Job job{.command = CommandKind::Move,
                  .kind = "move",
                  .name = program.name,
                  .program = program,
                  .planned_s = *planned_s,
                  .detach = options.detach,
                  .take = options.take};
    return run_job(session, job, output);
}

ExitCode move_own(Session& session, const MoveVerbOptions& options, const Program& program, Output& output) {
    const Job job{.command = CommandKind::MoveOwn,
                  .kind = "own-move",
                  .name = "own-move",
                  .program = program,
                  .ticks = ticks_of(session.config(), options.move),
                  .planned_s = options.move.in_s,
                  .detach = options.detach,
                  .take = options.take};
    return run_job(session, job, output);
}

ExitCode move(const MoveVerbOptions& options) {
    Output output(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    // Checks names and numbers before any message is sent. Relative targets can be checked only with the axes'
    // positions.
    const std::vector<double> anywhere(machine->config.axes.size());
    if (auto program = move_program(machine->config, anywhere, options.move); !program && !options.move.relative) {
        return output.fail(bad_input(program.error()));
    }
    auto session = Session::open(*machine, Purpose::Command);
    if (!session) { return output.fail(session.error()); }
    const auto start_mm = start_places(*session);
    if (!start_mm) { return output.fail(start_mm.error()); }
    auto program = move_program(machine->config, *start_mm, options.move);
    if (!program) { return output.fail(bad_input(program.error())); }
    return options.move.own ? move_own(*session, options, *program, output)
                            : move_together(*session, *program, *start_mm, options, output);
}

}  // namespace

void add_move(Verb command) {
    const Verb verb = command.add_verb("move",
                                       "move axes to a place in machine coordinates\n"
                                       "The axes move together, in a straight line; with --own, each on its own.");
    const auto options = std::make_shared<MoveVerbOptions>();
    verb.add_option("targets", options->move.targets, "AXIS=MM, e.g. X=10 Y=-3.5; axes that are not named do not move")
        .required();
    verb.add_option("--feed", options->move.feed_mm_min,
                    "speed along the line, mm/min; default: as fast as the limits allow");
    verb.add_flag("--relative", options->move.relative, "targets are distances from each axis's present position");
    verb.add_flag("--own", options->move.own,
                  "move each axis on its own, by the method in its configuration; the axes arrive at different times");
    verb.add_option("--in", options->move.in_s,
                    "with --own: how long each axis's move lasts, s; only for axes with method: RANADE");
    add_detach(verb, options->detach);
    add_take(verb, *options);
    add_live_options(verb, *options);
    verb.footer(kInterrupted + footer("  lockstep move X=10 Y=20\n  lockstep move X=10 Y=20 --feed 600\n"
                                      "  lockstep move Z=-2.5 --relative\n  lockstep move --own X=20 Y=5\n"
                                      "  lockstep move --own X=20 --in 0.5\n"));
    verb.action([options] { return move(*options); });
}

}  // namespace lockstep
