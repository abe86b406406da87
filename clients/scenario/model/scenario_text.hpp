// Texts of the content of a scenario: for `scenario check`, for the events and for the checks.
#pragma once

#include <string>

#include "clients/scenario/model/scenario.hpp"

namespace lockstep::scenario {

std::string text_of(const Asked::Act& act);        // "kill axis-Y"
std::string text_of(const Asked::During& during);  // "at line 2, 0.1 s later: kill axis-Y"
std::string text_of(const Asked::Step& step);      // "run gcode"
std::string text_of(Asked::Step::Ending ending);   // "done"
std::string text_of(Asked::Phase phase);           // "Idle", as MachinePhase is called
std::string text_of(Asked::Place place);           // "a container each"

/// Every value of the scenario, but of the machine only its name and processes: a line for each step, line of its
/// program, scripted event and expectation.
std::string outline(const Scenario& scenario);

}  // namespace lockstep::scenario
