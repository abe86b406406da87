// Formats numbers for people.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lockstep {

/// "12 345"
std::string grouped(std::int64_t number);
/// "1 step", "12 345 steps"
std::string plural(std::int64_t count, const std::string& one);
/// "X", "X and Y", "X, Y and Z"
std::string in_words(const std::vector<std::string>& names);

}  // namespace lockstep
