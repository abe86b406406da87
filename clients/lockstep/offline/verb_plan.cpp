// lockstep plan
#include <memory>
#include <optional>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/offline/figure_files.hpp"
#include "clients/lockstep/offline/moves_csv.hpp"
#include "clients/lockstep/offline/plan_text.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/planning/plan_figures.hpp"
#include "clients/text/notes.hpp"
#include "clients/text/output.hpp"

namespace lockstep {
namespace {

struct PlanOptions : ProgramOptions {
    std::string svg_dir;
    std::string moves;
};

std::expected<PlannedFile, Failure> plan_and_draw(const PlanOptions& options, Output& output) {
    if (options.svg_dir.empty()) { return plan_file(options, output); }
    std::optional<PlanDrawing> drawing;
    auto planned = plan_file(options, output, [&drawing](const MachineConfig& machine) -> OnPlannedFrame {
        drawing.emplace(machine);
        return [&drawing](const PlannedFrame& frame) { drawing->take(frame); };
    });
    if (!planned) { return planned; }
    const auto drawn = write_figures(
        options.svg_dir, {{"xy.svg", drawing->path(planned->plan)}, {"speed.svg", drawing->speed(planned->plan)}});
    if (!drawn) { return std::unexpected(bad_input(drawn.error())); }
    return planned;
}

ExitCode report(const PlannedFile& planned, Output& output) {
    warn_of(planned.notes, output);
    output.print(plan_text(planned));
    output.report(to_report(planned.plan, planned.lines));
    return kExitDone;
}

ExitCode plan(const PlanOptions& options) {
    Output output(options.json);
    const auto planned = plan_and_draw(options, output);
    if (!planned) { return output.fail(planned.error()); }
    if (!options.moves.empty()) {
        const auto written = write_moves(options.moves, options.file, planned->setup);
        if (!written) { return output.fail(bad_input("--moves: " + written.error())); }
    }
    return report(*planned, output);
}

}  // namespace

void add_plan(Verb command) {
    const Verb verb = command.add_verb("plan",
                                       "report how long a G-code file takes, and the load on each axis\n"
                                       "The command needs no running machine.");
    const auto options = std::make_shared<PlanOptions>();
    add_program_options(verb, *options);
    add_start(verb, *options);
    verb.add_option("--svg", options->svg_dir, "draw xy.svg and speed.svg into this directory");
    verb.add_option("--moves", options->moves,
                    "write every motion into this CSV file, arcs as arcs: line, kind, the end by axes in machine "
                    "coordinates, feed, centre");
    verb.footer(
        footer("  lockstep plan plate.gcode --machine mill.textproto\n"
               "  lockstep plan plate.gcode --machine mill.textproto --start X=10,Y=5 --svg pictures\n"
               "  lockstep plan plate.gcode --moves moves.csv\n"));
    verb.action([options] { return plan(*options); });
}

}  // namespace lockstep
