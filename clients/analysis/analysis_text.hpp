// Writes an analysis as text, for a terminal and for the headings of figures.
#pragma once

#include <string>
#include <vector>

#include "clients/analysis/analysis.hpp"

namespace lockstep::analysis {

/// "3 axes · 128 450 steps · 12.4 s · nothing missing"
std::string in_a_line(const Analysis& analysis);

/// Remarks in addition to the tables, a sentence each: clock errors, missing or left-out messages, events, foreign
/// messages.
std::vector<std::string> notes(const Analysis& analysis);

/// The findings, tables of the axes, the jobs, the program events and the step skew between axes, and the notes.
std::string summary(const Analysis& analysis);

}  // namespace lockstep::analysis
