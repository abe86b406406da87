// An analysis in words, for a terminal and for the figures' headings.
#pragma once

#include <string>

#include "clients/analysis/analysis.hpp"

namespace lockstep::analysis {

/// "3 axes · 128 450 steps · 12.4 s · nothing missing"
std::string in_a_line(const Analysis& analysis);

/// A table of the axes, one of the jobs, and a sentence for everything that is missing, damaged or foreign.
std::string summary(const Analysis& analysis);

}  // namespace lockstep::analysis
