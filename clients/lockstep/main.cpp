// The lockstep command.
#include <algorithm>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/text/output.hpp"

namespace {

using namespace lockstep;

void add_verbs(CLI::App& app, Action& action) {
    add_up(app, action);
    add_status(app, action);
    add_watch(app, action);
    add_flight(app, action);
    add_spy(app, action);
    add_doctor(app, action);
    add_timing(app, action);
    add_keys(app, action);
    add_home(app, action);
    add_move(app, action);
    add_jog(app, action);
    add_run(app, action);
    add_interrupts(app, action);
    add_send(app, action);
    add_override(app, action);
    add_offsets(app, action);
    add_touch(app, action);
    add_tools(app, action);
    add_down(app, action);
    add_check(app, action);
    add_plan(app, action);
    add_simulate(app, action);
    add_analyze(app, action);
    add_verify(app, action);
    add_log(app, action);
    add_machine(app, action);
    add_config(app, action);
    add_export(app, action);
    add_replay(app, action);
    add_compare(app, action);
    add_scenario(app, action);
}

/// CLI11's message, except for an unknown verb, which CLI11 would report as missing. Adds which help to read.
std::string what_is_wrong(const CLI::App& app, const CLI::ParseError& error, const std::string& first) {
    const auto verbs = app.get_subcommands([](const CLI::App*) { return true; });
    const bool known = std::ranges::any_of(verbs, [&](const CLI::App* verb) { return verb->get_name() == first; });
    if (known) { return error.what() + std::string("; see: lockstep ") + first + " --help"; }
    const bool is_verb = !first.empty() && !first.starts_with('-');
    return (is_verb ? "there is no verb '" + first + "'" : error.what()) + std::string("; see: lockstep --help");
}

/// Prints help and version to standard output. Reports everything else as bad usage, in JSON if JSON was requested.
int report_usage(const CLI::App& app, const CLI::ParseError& error, const std::string& first, bool json) {
    if (error.get_exit_code() == 0) { return app.exit(error); }
    return Output(json).fail(bad_input(what_is_wrong(app, error, first)));
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Lockstep moves stepper axes that run in separate processes as if one chip drove them all.",
                 "lockstep"};
    app.set_version_flag("--version", "lockstep " LOCKSTEP_VERSION);
    app.require_subcommand(1);
    app.footer(footer("  lockstep up --machine mill.textproto\n  lockstep home\n  lockstep move X=10 Y=20\n"
                      "  lockstep run plate.gcode\n  lockstep down\n") +
               "\nOptions of a verb: lockstep VERB --help");
    Action action;
    add_verbs(app, action);
    const bool json =
        std::any_of(argv, argv + argc, [](const char* word) { return std::string_view(word) == "--json"; });
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) { return report_usage(app, error, argc > 1 ? argv[1] : "", json); }
    return action();
}
