// The rule of max_following_error_mm: how far the encoder of a motor may be from its count.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

#include "services/documents/problem_list.hpp"
#include "services/documents/rules/axis_ranges.hpp"

namespace lockstep {

/// Adds the problem of a limit that is less than a step, because a motor is always up to a step behind. key: its place.
inline void check_following_error(const std::string& key, std::optional<double> most_mm, double steps_per_mm,
                                  ProblemList& problems) {
    if (!most_mm) { return; }
    const double least = 1 / steps_per_mm;
    const bool is_enough = axis_ranges::is_at_least(*most_mm, least) && *most_mm <= axis_ranges::kMaxSteps * least;
    problems.require(is_enough, key,
                     fmt::format("max_following_error_mm is {}; it must be at least {}, a step of the motor",
                                 number_text(*most_mm), number_text(least)));
}

}  // namespace lockstep
