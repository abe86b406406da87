// Writes an analysis as text, for a terminal and for the headings of figures.
#pragma once

#include <string>
#include <vector>

#include "clients/analysis/analysis.hpp"

namespace lockstep::analysis {

/// The remedy if a log lacks messages. The log's writer may have missed messages that their sender has in its own log.
inline constexpr const char* kWhereTheRestIs =
    "missing messages are in the processes' own logs: lockstep log merge combines them";

/// "3 axes · 128 450 steps · 12.4 s · nothing missing"
std::string in_a_line(const Analysis& analysis);

/// Remarks in addition to the tables, a sentence each: clock errors, missing or left-out messages, events, foreign
/// messages.
std::vector<std::string> notes(const Analysis& analysis);

/// The findings, tables of the axes, the jobs, the program events and the step skew between axes, and the notes.
std::string summary(const Analysis& analysis);

}  // namespace lockstep::analysis
