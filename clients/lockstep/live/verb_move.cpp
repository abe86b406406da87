// lockstep move
#include "clients/lockstep/live/job.hpp"
#include "clients/lockstep/live/move_program.hpp"
#include "clients/lockstep/verb.hpp"

namespace lockstep {
namespace {

struct MoveVerbOptions : LiveOptions {
    MoveOptions move;
};

ExitCode move(const MoveVerbOptions& options) {
    Voice voice(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return voice.fail(machine.error()); }
    // Names and numbers are judged before anybody is asked; a relative place once it is known where the axes stand.
    const std::vector<double> anywhere(machine->config.axes.size());
    if (auto program = move_program(machine->config, anywhere, options.move); !program && !options.move.relative) {
        return voice.fail(bad_input(program.error()));
    }
    auto session = Session::open(*machine);
    if (!session) { return voice.fail(session.error()); }
    const auto start_mm = start_places(*session);
    if (!start_mm) { return voice.fail(start_mm.error()); }
    auto program = move_program(machine->config, *start_mm, options.move);
    if (!program) { return voice.fail(bad_input(program.error())); }
    const auto planned_s = planned_seconds(machine->config, *program, *start_mm);
    if (!planned_s) { return voice.fail(planned_s.error()); }
    const Job job{.command = CommandKind::Move,
                  .kind = "move",
                  .name = program->name,
                  .program = *program,
                  .planned_s = *planned_s};
    return run_job(*session, job, voice);
}

}  // namespace

void add_move(CLI::App& app, Action& action) {
    CLI::App* verb =
        app.add_subcommand("move", "move axes together, in a straight line, to a place in machine coordinates");
    const auto options = std::make_shared<MoveVerbOptions>();
    verb->add_option("targets", options->move.targets, "AXIS=MM, e.g. X=10 Y=-3.5; axes not named stay")->required();
    verb->add_option("--feed", options->move.feed_mm_min,
                     "speed along the line, mm/min; as fast as allowed where not given");
    verb->add_flag("--relative", options->move.relative, "targets are from where each axis stands");
    add_live_options(*verb, *options);
    verb->footer(
        footer("  lockstep move X=10 Y=20\n  lockstep move X=10 Y=20 --feed 600\n  lockstep move Z=-2.5 --relative\n"));
    verb->callback([&action, options] { action = [options] { return move(*options); }; });
}

}  // namespace lockstep
