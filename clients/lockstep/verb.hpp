// The verbs of the command, with their options and actions. A separate file adds each verb.
#pragma once

#include "services/arguments/argument_parser.hpp"

namespace lockstep {

void add_check(Verb command);
void add_plan(Verb command);
void add_simulate(Verb command);
void add_analyze(Verb command);
void add_verify(Verb command);
void add_log(Verb command);      // merge
void add_machine(Verb command);  // check
void add_config(Verb command);
void add_export(Verb command);
void add_replay(Verb command);
void add_compare(Verb command);
void add_scenario(Verb command);

void add_up(Verb command);
void add_down(Verb command);
void add_status(Verb command);
void add_watch(Verb command);
void add_doctor(Verb command);
void add_board(Verb command);   // list, check, bench
void add_timing(Verb command);  // apply
void add_flight(Verb command);
void add_keys(Verb command);  // make, show, check
void add_spy(Verb command);
void add_home(Verb command);
void add_move(Verb command);
void add_probe(Verb command);         // edge, angle, corner, bore, boss, tool, surface
void add_measurements(Verb command);  // of probe
void add_jog(Verb command);
void add_run(Verb command);
void add_send(Verb command);
void add_override(Verb command);
void add_offsets(Verb command);  // set, clear
void add_touch(Verb command);
void add_tools(Verb command);       // set, remove
void add_interrupts(Verb command);  // hold, resume, stop, estop, reset

}  // namespace lockstep
