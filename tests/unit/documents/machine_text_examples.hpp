// Configurations for the tests here: the shortest that is valid, and changes to it.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace lockstep {

/// Each key has its own line, so that the places of errors are known: name is on line 1, the axis begins on line 2.
inline constexpr std::string_view kShortest = R"(name: "m"
axis {
  name: "X"
  steps_per_mm: 80
  start_velocity_mm_s: 10
  max_velocity_mm_s: 150
  max_accel_mm_s2: 1500
  position_min_mm: 0
  position_max_mm: 200
}
)";

/// kShortest with one piece of it replaced.
inline std::string with(std::string_view from, std::string_view to, std::string_view text = kShortest) {
    std::string changed(text);
    const std::size_t at = changed.find(from);
    if (at == std::string::npos) { throw std::logic_error("no such piece: " + std::string(from)); }
    return changed.replace(at, from.size(), to);
}

/// kShortest with `line` added at the end of its axis, as line 10.
inline std::string axis_with(std::string_view line) { return with("200\n", "200\n  " + std::string(line) + "\n"); }

/// kShortest with `line` added at its end, as line 11.
inline std::string machine_with(std::string_view line) { return std::string(kShortest) + std::string(line) + "\n"; }

}  // namespace lockstep
