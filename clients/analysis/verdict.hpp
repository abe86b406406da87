// Whether what a log holds was good, and why, in plain words.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "clients/analysis/analysis.hpp"

namespace lockstep::analysis {

enum class Grade : std::uint8_t {
    Good,      // as asked
    Doubtful,  // the record lacks something, or it is not all that was asked
    Unknown,   // cannot be told: the log lacks what the answer rests on
    Bad,       // not what was asked
};

std::string_view name_of(Grade grade);

struct Finding {
    Grade grade = Grade::Good;
    std::string text;  // a sentence without its full stop
};

/// The gravest first; never empty.
std::vector<Finding> findings(const Analysis& analysis);

/// The gravest of them.
Grade verdict(const std::vector<Finding>& findings);

/// "good: nothing is missing, ..." in a line.
std::string headline(const std::vector<Finding>& findings);

}  // namespace lockstep::analysis
