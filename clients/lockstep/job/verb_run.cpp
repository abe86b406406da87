// lockstep run
#include <fmt/format.h>

#include "clients/lockstep/height_option.hpp"
#include "clients/lockstep/job/approach_text.hpp"
#include "clients/lockstep/job/confirm.hpp"
#include "clients/lockstep/job/job.hpp"
#include "clients/lockstep/job/restart.hpp"
#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/planning/program_text.hpp"
#include "clients/session/job_plan.hpp"
#include "clients/session/program_start.hpp"
#include "clients/session/waits.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/format.hpp"
#include "clients/text/notes.hpp"
#include "idl/proto/report.pb.h"
#include "services/documents/program_file.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {
namespace {

struct RunOptions : LiveOptions {
    std::string file;
    GcodeSwitches switches;
    std::string height_map;  // a file; empty: the surface is level
    bool dry_run = false;
    RestartOptions restart;
    std::string started_at;  // the machine's position when the program's first run began
    bool yes = false;        // do not ask
    bool detach = false;

    bool is_restart() const { return restart.from_line > 0; }
};

/// `amount` is "12 blocks" or "12 lines".
ExitCode report_dry_run(const std::string& name, const std::string& amount, double planned_s, proto::RunReport report,
                        Output& output) {
    report.set_kind("run");
    report.set_name(name);
    report.set_outcome("dry-run");
    report.set_planned_s(planned_s);
    output.report(report);
    output.print(fmt::format("{}: would run {} in {} from the machine's present position; nothing was sent", name,
                             amount, duration_text(planned_s)));
    return kExitDone;
}

/// The machine before a program: where its axes stand, and its offsets and tools.
struct Start {
    Session session;
    std::vector<double> stands_mm;
    RevisedValues values;
};

std::expected<Start, Failure> reach_start(const RunOptions& options) {
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return std::unexpected(machine.error()); }
    auto session = Session::open(*machine, Purpose::Command);
    if (!session) { return std::unexpected(session.error()); }
    auto stands_mm = start_places(*session);
    if (!stands_mm) { return std::unexpected(stands_mm.error()); }
    auto values = await_values(*session);
    if (!values) { return std::unexpected(values.error()); }
    return Start{*std::move(session), *std::move(stands_mm), *std::move(values)};
}

/// Reads the whole program for the machine's position, or with --from-line for the position at its first run.
std::expected<ProgramFile, Failure> read_file(const RunOptions& options, const MachineSetup& machine,
                                              const std::vector<double>& stands_mm, const gcode::KeptValues& values,
                                              Output& output) {
    const auto started = options.is_restart() ? places_at_start(machine, options.started_at) : stands_mm;
    if (!started) { return std::unexpected(bad_input("--started-at: " + started.error())); }
    auto file = read_program_file(options.file, machine, *started, options.switches, values);
    if (!file) { return std::unexpected(bad_file(options.file, file.error())); }
    warn_of(file->reading.notes, output);
    return *std::move(file);
}

struct Chosen : Rest {
    gcode::ProgramValues values;
};

void print_approach(const RunOptions& options, const MachineSetup& machine, const Rest& rest, Output& output) {
    output.print(fmt::format("from line {}:\n{}{}", options.restart.from_line,
                             approach_text(rest.program, rest.approach), modal_text(machine, rest.modal)));
}

/// The program to run: all of it, or an approach and the rest. Prints an approach.
std::expected<Chosen, Failure> choose(const RunOptions& options, std::string_view text, const MachineSetup& machine,
                                      const std::vector<double>& stands_mm, const RevisedValues& before,
                                      Output& output) {
    auto file = read_file(options, machine, stands_mm, before.values, output);
    if (!file) { return std::unexpected(file.error()); }
    gcode::ProgramValues values{.revision = before.revision, .after = {}};
    if (file->reading.values != before.values) { values.after = std::move(file->reading.values); }
    if (!options.is_restart()) { return Chosen{{std::move(file->reading.program), {}, {}}, std::move(values)}; }
    auto rest = rest_of(file->reading.program, text, file->setup, options.restart, machine, stands_mm);
    if (!rest) { return std::unexpected(bad_input("--from-line: " + rest.error())); }
    print_approach(options, machine, *rest, output);
    return Chosen{*std::move(rest), std::move(values)};
}

/// A restart moves the machine before the program does. A person must confirm the approach, or a script pass --yes.
std::expected<void, Failure> confirm(const RunOptions& options, const Output& output) {
    if (options.yes || !options.is_restart()) { return {}; }
    return confirm_motion(options.json, output,
                          "--from-line first moves the machine to where that line begins, and without a terminal it "
                          "cannot ask: check it with --dry-run, then add --yes");
}

/// Whether the program is read while it runs. A short file is read and checked as a whole before anything moves.
bool is_streamed(const RunOptions& options) {
    return options.file == "-" || (is_long_program(options.file) && !options.dry_run);
}

/// Reads the lines that must be known before anything moves: the first lines, or all up to the one to begin with.
std::expected<void, Failure> read_first(const RunOptions& options, const MachineSetup& machine,
                                        const std::vector<double>& stands_mm, ProgramStream& stream, Output& output) {
    if (!options.is_restart()) {
        const auto read = stream.read_first();
        return read ? std::expected<void, Failure>{} : std::unexpected(bad_file(options.file, read.error()));
    }
    const auto beginning = stream.skip_before(options.restart.from_line);
    if (!beginning) { return std::unexpected(bad_file(options.file, beginning.error())); }
    const auto rest = rest_of(beginning->program, beginning->modal, options.restart, machine, stands_mm);
    if (!rest) { return std::unexpected(bad_input("--from-line: " + rest.error())); }
    print_approach(options, machine, *rest, output);
    stream.replace_first(rest->program);
    return {};
}

/// Whether the program has probing moves. The lines behind such a move depend on the touch, so they are read while the
/// program runs.
bool does_probe(std::string_view text, const GcodeSetup& setup) {
    bool probes = false;
    (void)gcode_actions(text, setup, [&](const gcode::Action& action, int) {
        probes |= std::holds_alternative<gcode::Probing>(action);
    });
    return probes;
}

ExitCode run_stream(const RunOptions& options, Start& start, LineReader lines, Output& output);

ExitCode run_stream(const RunOptions& options) {
    Output output(options.json);
    if (options.file == "-" && options.dry_run) {
        return output.fail(bad_input("standard input is read once, so --dry-run needs a file"));
    }
    auto lines = LineReader::open(options.file);
    if (!lines) { return output.fail(bad_file(options.file, {{.message = lines.error()}})); }
    auto start = reach_start(options);
    if (!start) { return output.fail(start.error()); }
    return run_stream(options, *start, *std::move(lines), output);
}

ExitCode run_stream(const RunOptions& options, Start& start, LineReader lines, Output& output) {
    const MachineSetup& machine = start.session.config();
    const auto started_mm = options.is_restart() ? places_at_start(machine, options.started_at) : start.stands_mm;
    if (!started_mm) { return output.fail(bad_input("--started-at: " + started_mm.error())); }
    const std::string name = options.file == "-" ? "standard input" : options.file;
    ProgramStream stream(std::move(lines),
                         program_setup(name, machine, *started_mm, options.switches, start.values.values),
                         start.values.revision);
    if (auto read = read_first(options, machine, start.stands_mm, stream, output); !read) {
        return output.fail(read.error());
    }
    if (options.dry_run) {
        output.print("nothing was sent");
        return kExitDone;
    }
    if (options.detach && stream.awaits_touch()) {
        return output.fail(
            bad_input("the program probes, and this command runs what follows a touch; leave --detach out"));
    }
    if (const auto confirmed = confirm(options, output); !confirmed) { return output.fail(confirmed.error()); }
    warn_of(stream.take_notes(), output);
    const Job job{.command = CommandKind::Run,
                  .kind = "run",
                  .name = stream.head().name,
                  .stream = &stream,
                  .detach = options.detach,
                  .take = options.take};
    return run_job(start.session, job, output);
}

/// Plans a long file while reading it.
ExitCode plan_stream(const RunOptions& options) {
    Output output(options.json);
    auto lines = LineReader::open(options.file);
    if (!lines) { return output.fail(bad_file(options.file, {{.message = lines.error()}})); }
    const auto start = reach_start(options);
    if (!start) { return output.fail(start.error()); }
    const auto text = std::make_shared<ProgramText>(
        *std::move(lines),
        program_setup(options.file, start->session.config(), start->stands_mm, options.switches, start->values.values));
    const auto planned_s = planned_seconds(start->session, text->head(), text, start->stands_mm);
    if (!text->errors().empty()) { return output.fail(bad_file(options.file, text->errors())); }
    if (!planned_s) { return output.fail(bad_file(options.file, planned_s.error().errors)); }
    return report_dry_run(text->head().name, fmt::format("{} lines", text->lines()), *planned_s, {}, output);
}

ExitCode run_file(const RunOptions& options) {
    if (is_streamed(options)) { return run_stream(options); }
    if (is_long_program(options.file) && !options.is_restart()) { return plan_stream(options); }
    Output output(options.json);
    const auto text = read_text_file(options.file);
    if (!text) { return output.fail(bad_file(options.file, {text.error()})); }
    auto start = reach_start(options);
    if (!start) { return output.fail(start.error()); }
    const GcodeSetup setup =
        program_setup(options.file, start->session.config(), start->stands_mm, options.switches, start->values.values);
    if (!options.dry_run && does_probe(*text, setup)) {
        auto lines = LineReader::open(options.file);
        if (!lines) { return output.fail(bad_file(options.file, {{.message = lines.error()}})); }
        return run_stream(options, *start, *std::move(lines), output);
    }
    auto chosen = choose(options, *text, start->session.config(), start->stands_mm, start->values, output);
    if (!chosen) { return output.fail(chosen.error()); }
    const auto planned_s = planned_seconds(start->session, chosen->program, start->stands_mm);
    if (!planned_s) { return output.fail(bad_file(options.file, planned_s.error().errors)); }
    if (options.dry_run) {
        proto::RunReport report;
        fill_approach(chosen->program, chosen->approach, report);
        return report_dry_run(chosen->program.name, fmt::format("{} blocks", chosen->program.blocks.size()), *planned_s,
                              std::move(report), output);
    }
    const Job job{.command = CommandKind::Run,
                  .kind = "run",
                  .name = chosen->program.name,
                  .program = std::move(chosen->program),
                  .values = std::move(chosen->values),
                  .planned_s = *planned_s,
                  .detach = options.detach,
                  .take = options.take};
    if (const auto confirmed = confirm(options, output); !confirmed) { return output.fail(confirmed.error()); }
    return run_job(start->session, job, output);
}

ExitCode run(RunOptions& options) {
    if (auto heights = read_heights(options.height_map, options.switches); !heights) {
        return Output(options.json).fail(heights.error());
    }
    return run_file(options);
}

void add_restart_options(Verb verb, RunOptions& options) {
    const Argument from_line =
        verb.add_option("--from-line", options.restart.from_line,
                        "run only from this line on: the axes lift, move to the start of the line and go down with the "
                        "program's feed; "
                        "the command shows this motion and asks before it begins; --dry-run only shows it")
            .in_range(1, 100'000'000);
    const Argument lift = verb.add_option(
        "--lift", options.restart.lift,
        "with --from-line: the axes that leave the work first, and positions clear "
        "of it, in mm: Z=40; default: the axes with a safe_height_mm, to this height; else the axes that "
        "home first, to their park positions");
    const Argument straight = verb.add_flag(
        "--straight", options.restart.straight,
        "with --from-line: move to the start of the line in one straight line, as fast as the limits allow");
    const Argument yes = verb.add_flag("--yes", options.yes, "with --from-line: begin without asking");
    for (const Argument option : {lift, straight, yes}) { option.needs(from_line); }
    straight.excludes(lift);
    verb.add_option(
        "--started-at", options.started_at,
        "with --from-line: where the program's first run started, in mm: X=10,Y=5; axes that are not named were "
        "at their park positions");
}

}  // namespace

void add_run(Verb command) {
    const Verb verb = command.add_verb("run",
                                       "run a G-code file, and wait for its end\n"
                                       "The program begins at the machine's present position.");
    const auto options = std::make_shared<RunOptions>();
    verb.add_option(
            "file", options->file,
            "the G-code file; - for standard input. Of a long file only the first lines are checked before anything "
            "moves; the others are checked while it runs")
        .required();
    verb.add_flag("--dry-run", options->dry_run,
                  "read, check and plan it for the machine's present position; nothing moves");
    add_restart_options(verb, *options);
    add_detach(verb, options->detach);
    verb.add_flag("--optional-stop", options->switches.pause_at_m1, "also pause at M1");
    verb.add_flag("--ignore-unassigned", options->switches.ignore_unassigned,
                  "ignore words for devices that the machine does not have, instead of refusing them");
    add_height_map(verb, options->height_map);
    add_take(verb, *options);
    add_live_options(verb, *options);
    verb.footer(kInterrupted + footer("  lockstep run plate.gcode\n  lockstep run plate.gcode --height-map "
                                      "heights.csv\n  lockstep run plate.gcode --dry-run\n"
                                      "  lockstep run plate.gcode --from-line 120 --dry-run\n"
                                      "  lockstep run plate.gcode --from-line 120 --lift Z=40 --yes\n"
                                      "  lockstep run plate.gcode --detach\n  generate-moves | lockstep run -\n  "
                                      "lockstep run plate.gcode --json > report.json\n"));
    verb.action([options] { return run(*options); });
}

}  // namespace lockstep
