// Rates the content of a log, with the reasons as text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "clients/analysis/analysis.hpp"

namespace lockstep::analysis {

enum class Grade : std::uint8_t {
    Good,      // the motion is as commanded
    Doubtful,  // the record lacks something, or the motion is not exactly as commanded
    Unknown,   // the log lacks the data for the answer
    Bad,       // the motion is not as commanded
};

std::string_view name_of(Grade grade);

struct Finding {
    Grade grade = Grade::Good;
    std::string text;  // a sentence without its full stop
};

/// The most serious first; never empty.
std::vector<Finding> findings(const Analysis& analysis);

/// The most serious grade.
Grade worst_grade(const std::vector<Finding>& findings);

}  // namespace lockstep::analysis
