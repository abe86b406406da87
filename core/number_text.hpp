// Numbers and lists as a person would write them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lockstep {

/// With at most `digits` digits, without trailing zeros.
std::string number_text(double value, int digits = 9);
/// The relative rounding of number_text(). Rules allow it, so that they accept a limit that a person copies from their
/// message.
inline constexpr double kTextRounding = 1e-8;
/// With at most six digits, for limits and remedies in messages.
std::string short_number(double value);
/// "12 345"
std::string grouped(std::int64_t number);
/// "1 step", "12 345 steps"
std::string plural(std::int64_t count, const std::string& one);
/// "X", "X and Y", "X, Y and Z"
std::string in_words(const std::vector<std::string>& names);

}  // namespace lockstep
