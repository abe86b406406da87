// The lockstep command.
#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/text/output.hpp"

namespace {

using namespace lockstep;

struct Group {
    const char* heading;
    std::initializer_list<void (*)(Verb)> verbs;
};

const Group kGroups[] = {
    {"Verbs that set up a machine", {add_machine, add_config, add_keys, add_doctor, add_board, add_timing}},
    {"Verbs that operate a machine",
     {add_up, add_status, add_watch, add_home, add_move, add_probe, add_jog, add_run, add_send, add_down}},
    {"Verbs that interrupt or change a job", {add_interrupts, add_override}},
    {"Verbs for offsets and tools", {add_offsets, add_touch, add_tools}},
    {"Verbs for programs, without a machine", {add_check, add_plan, add_simulate, add_compare, add_scenario}},
    {"Verbs for records of a machine", {add_analyze, add_verify, add_replay, add_log, add_export, add_spy, add_flight}},
};

void add_verbs(const Verb& command) {
    for (const Group& group : kGroups) {
        const Verb listed = command.under(group.heading);
        for (const auto add : group.verbs) { add(listed); }
    }
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
