// lockstep run
#include <CLI/CLI.hpp>

#include "clients/lockstep/live/job.hpp"
#include "clients/lockstep/live/live_options.hpp"
#include "clients/lockstep/live/program_start.hpp"
#include "clients/lockstep/live/words.hpp"
#include "clients/lockstep/verb.hpp"
#include "idl/proto/report.pb.h"
#include "services/documents/program_file.hpp"
#include "services/documents/text_file.hpp"

namespace lockstep {
namespace {

struct RunOptions : LiveOptions {
    std::string file;
    GcodeSwitches switches;
    bool dry_run = false;
    int from_line = 0;       // 0: all of it
    std::string started_at;  // where the machine stood when it ran from its beginning
    bool detach = false;
};

ExitCode say_dry_run(const Job& job, Voice& voice) {
    proto::RunReport report;
    report.set_kind(job.kind);
    report.set_name(job.name);
    report.set_outcome("dry-run");
    report.set_planned_s(*job.planned_s);
    voice.report(report);
    voice.say(job.name + ": would run " + std::to_string(job.program->blocks.size()) + " blocks in " +
              duration_text(*job.planned_s) + " from where the machine stands; nothing was sent");
    return kExitDone;
}

/// The whole program, made for where the machine stands, or the rest of one that was begun elsewhere.
std::expected<Program, Failure> read(const RunOptions& options, const MachineConfig& machine,
                                     const std::vector<double>& stands_mm) {
    const bool is_rest = options.from_line > 0;
    const auto started = is_rest ? places_at_start(machine, options.started_at) : stands_mm;
    if (!started) { return std::unexpected(bad_input("--started-at: " + started.error())); }
    auto program = load_gcode_file(options.file, machine, *started, options.switches);
    if (!program) { return std::unexpected(bad_file(options.file, program.error())); }
    if (!is_rest) { return *std::move(program); }
    auto rest = program_from(*program, options.from_line, stands_mm);
    if (!rest) { return std::unexpected(bad_input("--from-line: " + rest.error())); }
    return *std::move(rest);
}

/// What a rest of a program does first: a person must know before it moves.
std::string approach_text(const Program& program) {
    const auto* first = program.blocks.empty() ? nullptr : std::get_if<LinearMove>(&program.blocks.front().action);
    if (first == nullptr || !first->rapid) { return "begins where the machine stands"; }
    std::string places;
    for (std::size_t i = 0; i < program.axes.size(); ++i) {
        places += " " + program.axes[i] + "=" + fixed(first->target_mm[i], 3);
    }
    return "first goes straight to" + places + ", as fast as it can";
}

ExitCode run(const RunOptions& options) {
    Voice voice(options.json);
    if (const auto text = read_text_file(options.file); !text) {
        return voice.fail(bad_file(options.file, {text.error()}));
    }
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return voice.fail(machine.error()); }
    auto session = Session::open(*machine, Purpose::Command);
    if (!session) { return voice.fail(session.error()); }
    const auto start_mm = start_places(*session);
    if (!start_mm) { return voice.fail(start_mm.error()); }
    auto program = read(options, machine->config, *start_mm);
    if (!program) { return voice.fail(program.error()); }
    const auto planned_s = planned_seconds(*session, *program, *start_mm);
    if (!planned_s) { return voice.fail(bad_file(options.file, planned_s.error().errors)); }
    const Job job{.command = CommandKind::Run,
                  .kind = "run",
                  .name = program->name,
                  .program = *std::move(program),
                  .planned_s = *planned_s,
                  .detach = options.detach};
    if (options.from_line > 0) {
        voice.say("from line " + std::to_string(options.from_line) + ": " + approach_text(*job.program));
    }
    return options.dry_run ? say_dry_run(job, voice) : run_job(*session, job, voice);
}

}  // namespace

void add_run(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand("run", "run a G-code file from where the machine stands, and wait for its end");
    const auto options = std::make_shared<RunOptions>();
    verb->add_option("file", options->file, "the G-code file")->required();
    verb->add_flag("--dry-run", options->dry_run, "read, check and plan it for where the machine stands; move nothing");
    verb->add_option("--from-line", options->from_line,
                     "only from this line on, first going straight to where it begins: try --dry-run before")
        ->check(CLI::Range(1, 100'000'000));
    verb->add_option("--started-at", options->started_at,
                     "with --from-line: where the program's first run started, in mm, X=10,Y=5; those not named were "
                     "parked");
    add_detach(*verb, options->detach);
    verb->add_flag("--optional-stop", options->switches.pause_at_m1, "pause at M1 too");
    add_live_options(*verb, *options);
    verb->footer(kInterrupted +
                 footer("  lockstep run plate.gcode\n  lockstep run plate.gcode --dry-run\n"
                        "  lockstep run plate.gcode --from-line 120 --dry-run\n"
                        "  lockstep run plate.gcode --detach\n  lockstep run plate.gcode --json > report.json\n"));
    verb->callback([&action, options] { action = [options] { return run(*options); }; });
}

}  // namespace lockstep
