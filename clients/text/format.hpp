// Formats numbers, durations, axis names and long lines for a person.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace lockstep {

/// With `digits` digits after the point.
std::string fixed(double value, int digits);
/// The name of an axis, with its unit unless that is mm: "X", "C (deg)".
std::string axis_label(const std::string& name);
/// "8.2 s", "3 min 05 s", "2 h 03 min".
std::string duration_text(double seconds);
/// "2026-03-01T12:00:00Z".
std::string utc_text(std::chrono::system_clock::time_point time);
/// Lines of at most `width` characters, broken at spaces; all but the first begin with `indent`.
std::string wrapped(std::string_view text, std::size_t width, const std::string& indent);

}  // namespace lockstep
