// An analysis in words, for a terminal and for the figures' headings.
#pragma once

#include <string>
#include <vector>

#include "clients/analysis/analysis.hpp"

namespace lockstep::analysis {

/// What to do where a log lacks messages: who heard them may have stood still, not who sent them.
inline constexpr const char* kWhereTheRestIs =
    "what was not heard is in the processes' own logs: lockstep log merge puts them together";

/// "3 axes · 128 450 steps · 12.4 s · nothing missing"
std::string in_a_line(const Analysis& analysis);

/// A sentence for everything that is worth knowing besides the tables: what is missing, set anew, damaged, foreign.
std::vector<std::string> notes(const Analysis& analysis);

/// A table of the axes, one of the jobs, one of the step skew between axes, and the notes.
std::string summary(const Analysis& analysis);

}  // namespace lockstep::analysis
