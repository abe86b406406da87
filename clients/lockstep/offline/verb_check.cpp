// lockstep check
#include <memory>

#include <CLI/CLI.hpp>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/offline/plan_text.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/text/output.hpp"

namespace lockstep {
namespace {

struct CheckOptions {
    std::string file;
    std::string machine_file;
    std::string start;
    GcodeSwitches switches;
    bool json = false;
};

ExitCode check(const CheckOptions& options) {
    Output output(options.json);
    const auto input = read_program(options.file, options.machine_file, options.start, options.switches);
    if (!input) { return output.fail(input.error()); }
    warn(*input, output);
    output.print(options.file + ": no errors\n" + plan_text(*input));
    output.report(to_report(input->plan, input->lines));
    return kExitDone;
}

}  // namespace

void add_check(CLI::App& app, Action& action) {
    CLI::App* verb =
        app.add_subcommand("check",
                           "read a G-code file as the machine would: errors by line and column, words that "
                           "are passed over, travel and duration; needs no running machine");
    const auto options = std::make_shared<CheckOptions>();
    verb->add_option("file", options->file, "the G-code file")->required();
    verb->add_option("--machine", options->machine_file, "the machine's configuration file; else $LOCKSTEP_MACHINE");
    verb->add_option("--start", options->start,
                     "the start position in mm: X=10,Y=5; axes not named are at their park positions");
    verb->add_flag("--ignore-unassigned", options->switches.ignore_unassigned,
                   "pass over words for devices that the machine does not have, instead of refusing them");
    verb->add_flag("--json", options->json, "one JSON report on standard output instead of text");
    verb->footer(footer("  lockstep check plate.gcode --machine mill.textproto\n"));
    verb->callback([&action, options] { action = [options] { return check(*options); }; });
}

}  // namespace lockstep
