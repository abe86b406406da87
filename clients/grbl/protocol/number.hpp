// Writes a number as grbl does, with a fixed number of digits after the point.
#pragma once

#include <fmt/format.h>

#include <string>

namespace lockstep::grbl {

inline constexpr double kInch_mm = 25.4;

inline std::string number(double value, int digits) { return fmt::format("{:.{}f}", value, digits); }

}  // namespace lockstep::grbl
