// The verbs of the command, with their options and actions. A separate file adds each verb.
#pragma once

#include <functional>

#include "clients/text/exit_code.hpp"

namespace CLI {
class App;
}

namespace lockstep {

/// The action of the parsed command line. The chosen verb sets it.
using Action = std::function<ExitCode()>;

void add_check(CLI::App& app, Action& action);
void add_plan(CLI::App& app, Action& action);
void add_simulate(CLI::App& app, Action& action);
void add_analyze(CLI::App& app, Action& action);
void add_verify(CLI::App& app, Action& action);
void add_log(CLI::App& app, Action& action);      // merge
void add_machine(CLI::App& app, Action& action);  // check
void add_config(CLI::App& app, Action& action);
void add_export(CLI::App& app, Action& action);
void add_replay(CLI::App& app, Action& action);
void add_compare(CLI::App& app, Action& action);
void add_scenario(CLI::App& app, Action& action);

void add_up(CLI::App& app, Action& action);
void add_down(CLI::App& app, Action& action);
void add_status(CLI::App& app, Action& action);
void add_watch(CLI::App& app, Action& action);
void add_doctor(CLI::App& app, Action& action);
void add_timing(CLI::App& app, Action& action);  // apply
void add_flight(CLI::App& app, Action& action);
void add_keys(CLI::App& app, Action& action);  // make, show, check
void add_spy(CLI::App& app, Action& action);
void add_home(CLI::App& app, Action& action);
void add_move(CLI::App& app, Action& action);
void add_jog(CLI::App& app, Action& action);
void add_run(CLI::App& app, Action& action);
void add_send(CLI::App& app, Action& action);
void add_override(CLI::App& app, Action& action);
void add_offsets(CLI::App& app, Action& action);  // set, clear
void add_touch(CLI::App& app, Action& action);
void add_tools(CLI::App& app, Action& action);       // set, remove
void add_interrupts(CLI::App& app, Action& action);  // hold, resume, stop, estop, reset

}  // namespace lockstep
