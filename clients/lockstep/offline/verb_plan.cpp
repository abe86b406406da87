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

ExitCode plan(const PlanOptions& options) {
    Output output(options.json);
    const auto input = read_program(options);
    if (!input) { return output.fail(input.error()); }
    warn(*input, output);
    if (!options.moves.empty()) {
        const auto written = write_text_file(options.moves, moves_csv(*input));
        if (!written) { return output.fail(bad_input("--moves: " + written.error())); }
    }
    if (!options.svg_dir.empty()) {
        const auto drawn =
            write_figures(options.svg_dir, {{"xy.svg", plan_path_figure(input->machine, input->plan)},
                                            {"speed.svg", plan_speed_figure(input->machine, input->plan)}});
        if (!drawn) { return output.fail(bad_input(drawn.error())); }
    }
    output.print(plan_text(*input));
    output.report(to_report(input->plan, input->lines));
    return kExitDone;
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
