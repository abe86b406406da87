// The expectations of a scenario as text: for `scenario check` and for the checks of a run.
#pragma once

#include <string>
#include <vector>

#include "clients/scenario/model/scenario.hpp"

namespace lockstep::scenario {

std::string text_of(const Asked::Final& end);      // "X at 10 mm to the step"
std::string text_of(const Asked::Vetoes& vetoes);  // "vetoes by X, Y"
std::string text_of(const Asked::Cause& cause);    // "cause process-ended of axis-X"

std::string path_text(const Asked::Expect& expect);           // "every step within 0.01 mm of the commanded line"
std::string interruptions_text(const Asked::Expect& expect);  // "2 interruptions of jobs"
std::string together_text(const Asked::Expect& expect);       // "X, Y ended each epoch with the same frame"
std::string phase_text(const Asked::Expect& expect);          // "the machine is Idle at the end"

std::string received_text(const Asked::AxisEnd& end);   // "X received", "X not received"
std::string corrected_text(const Asked::AxisEnd& end);  // "X made up 5 lost steps"
std::string homed_text(const Asked::AxisEnd& end);      // "X homed", "X not homed"
std::string fault_text(const Asked::AxisEnd& end);      // "X has fault limit-hit"

inline constexpr const char* kExactText = "every step as planned";
inline constexpr const char* kCompleteText = "nothing missing in the record";

/// "X, Y"; "none"
std::string listed_or_none(const std::vector<std::string>& names);

/// All expectations in the order of the checks. Also those that are checked unless the file says otherwise.
std::vector<std::string> expectation_texts(const Asked::Expect& expect);

}  // namespace lockstep::scenario
