// lockstep check
#include <memory>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/offline/plan_text.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/text/notes.hpp"
#include "clients/text/output.hpp"

namespace lockstep {
namespace {

ExitCode check(const ProgramOptions& options) {
    Output output(options.json);
    const auto input = plan_file(options, output);
    if (!input) { return output.fail(input.error()); }
    warn_of(input->notes, output);
    output.print(options.file + ": no errors\n" + plan_text(*input));
    output.report(to_report(input->plan, input->lines));
    return kExitDone;
}

}  // namespace

void add_check(Verb command) {
    const Verb verb =
        command.add_verb("check",
                         "read a G-code file as the machine would, and report errors\n"
                         "The command reports errors by line and column, ignored words, travel and duration. It "
                         "needs no running machine.");
    const auto options = std::make_shared<ProgramOptions>();
    add_program_options(verb, *options);
    add_start(verb, *options);
    verb.footer(footer("  lockstep check plate.gcode --machine mill.textproto\n"));
    verb.action([options] { return check(*options); });
}

}  // namespace lockstep
