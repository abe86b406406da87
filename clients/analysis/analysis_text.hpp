// The text of an analysis, for a terminal and for the headings of figures.
#pragma once

#include <string>
#include <vector>

#include "clients/analysis/analysis.hpp"

namespace lockstep::analysis {

/// The remedy if a log lacks messages: its writer may have missed them, while their sender has them.
inline constexpr const char* kWhereTheRestIs =
    "missing messages are in the processes' own logs: lockstep log merge combines them";

/// "3 axes · 128 450 steps · 12.4 s · nothing missing"
std::string in_a_line(const Analysis& analysis);

/// A sentence for each remark besides the tables: missing, reset, damaged or foreign messages.
std::vector<std::string> notes(const Analysis& analysis);

/// A table of the axes, one of the jobs, one of the step skew between axes, and the notes.
std::string summary(const Analysis& analysis);

}  // namespace lockstep::analysis
