// lockstep plan
#include <memory>

#include <CLI/CLI.hpp>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/offline/figure_files.hpp"
#include "clients/lockstep/offline/moves_csv.hpp"
#include "clients/lockstep/offline/plan_text.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/planning/plan_figures.hpp"
#include "clients/text/output.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {
namespace {

struct PlanOptions : ProgramOptions {
    std::string svg_dir;
    std::string moves;
};

/// What needs all of the program at a time.
std::expected<void, Failure> write_files(const PlanOptions& options, const ProgramInput& input) {
    if (!options.moves.empty()) {
        const auto written = write_text_file(options.moves, moves_csv(input));
        if (!written) { return std::unexpected(bad_input("--moves: " + written.error())); }
    }
    if (options.svg_dir.empty()) { return {}; }
    const auto legs = plan_legs(input.machine, input.program, start_counts(input.machine, input.program.head()));
    if (!legs) { return std::unexpected(bad_file(options.file, {{legs.error().line, 0, legs.error().text}})); }
    const auto drawn =
        write_figures(options.svg_dir, {{"xy.svg", plan_path_figure(input.machine, input.plan, *legs)},
                                        {"speed.svg", plan_speed_figure(input.machine, input.plan, *legs)}});
    return drawn ? std::expected<void, Failure>{} : std::unexpected(bad_input(drawn.error()));
}

ExitCode report(const PlannedFile& planned, Output& output) {
    warn(planned, output);
    output.print(plan_text(planned));
    output.report(to_report(planned.plan, planned.lines));
    return kExitDone;
}

ExitCode plan(const PlanOptions& options) {
    Output output(options.json);
    if (options.moves.empty() && options.svg_dir.empty()) {
        const auto planned = plan_file(options, output);
        return planned ? report(*planned, output) : output.fail(planned.error());
    }
    const auto input = read_program(options);
    if (!input) { return output.fail(input.error()); }
    if (const auto written = write_files(options, *input); !written) { return output.fail(written.error()); }
    return report(*input, output);
}

}  // namespace

void add_plan(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand("plan",
                                        "report how long a G-code file takes and the load on each axis; "
                                        "needs no running machine");
    const auto options = std::make_shared<PlanOptions>();
    add_program_options(*verb, *options);
    add_start(*verb, *options);
    verb->add_option("--svg", options->svg_dir, "draw xy.svg and speed.svg into this directory");
    verb->add_option("--moves", options->moves,
                     "write every motion into this CSV file, arcs as arcs: line, kind, the end by axes in machine "
                     "coordinates, feed, centre");
    verb->footer(
        footer("  lockstep plan plate.gcode --machine mill.textproto\n"
               "  lockstep plan plate.gcode --machine mill.textproto --start X=10,Y=5 --svg pictures\n"
               "  lockstep plan plate.gcode --moves moves.csv\n"));
    verb->callback([&action, options] { action = [options] { return plan(*options); }; });
}

}  // namespace lockstep
