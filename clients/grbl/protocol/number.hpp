// Writes a number as grbl does, with a fixed number of digits after the point.
#pragma once

#include <cstdio>
#include <string>

namespace lockstep::grbl {

inline constexpr double kInch_mm = 25.4;

inline std::string number(double value, int digits) {
    char text[400];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

}  // namespace lockstep::grbl
