// The lockstep command.
#include <algorithm>
#include <string>
#include <string_view>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/text/output.hpp"

namespace {

using namespace lockstep;

void add_verbs(Verb command) {
    add_up(command);
    add_status(command);
    add_watch(command);
    add_flight(command);
    add_spy(command);
    add_doctor(command);
    add_timing(command);
    add_keys(command);
    add_home(command);
    add_move(command);
    add_jog(command);
    add_run(command);
    add_interrupts(command);
    add_send(command);
    add_override(command);
    add_offsets(command);
    add_touch(command);
    add_tools(command);
    add_down(command);
    add_check(command);
    add_plan(command);
    add_simulate(command);
    add_analyze(command);
    add_verify(command);
    add_log(command);
    add_machine(command);
    add_config(command);
    add_export(command);
    add_replay(command);
    add_compare(command);
    add_scenario(command);
}

}  // namespace

int main(int argc, char** argv) {
    ArgumentParser parser("Lockstep moves stepper axes that run in separate processes as if one chip drove them all.",
                          "lockstep");
    parser.version("lockstep " LOCKSTEP_VERSION);
    parser.footer(footer("  lockstep up --machine mill.textproto\n  lockstep home\n  lockstep move X=10 Y=20\n"
                         "  lockstep run plate.gcode\n  lockstep down\n") +
                  "\nOptions of a verb: lockstep VERB --help");
    add_verbs(parser);
    const bool json =
        std::any_of(argv, argv + argc, [](const char* word) { return std::string_view(word) == "--json"; });
    return parser.run(argc, argv, [json](const std::string& error) { return Output(json).fail(bad_input(error)); });
}
