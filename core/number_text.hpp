// A number as a person would write it.
#pragma once

#include <string>

namespace lockstep {

/// With at most `digits` digits, without trailing zeros.
std::string number_text(double value, int digits = 9);
/// The relative rounding of number_text(). Rules allow it, so that they accept a limit that a person copies from their
/// message.
inline constexpr double kTextRounding = 1e-8;
/// With at most six digits, for limits and remedies in messages.
std::string short_number(double value);

}  // namespace lockstep
