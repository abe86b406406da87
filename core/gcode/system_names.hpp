// The names of the coordinate systems, in the order of KeptValues::systems.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "core/gcode/state.hpp"

namespace lockstep {

inline constexpr std::array<std::string_view, gcode::kSystems> kSystemNames{"G54", "G55",   "G56",   "G57",  "G58",
                                                                            "G59", "G59.1", "G59.2", "G59.3"};

/// "G54" is 0, "G59.3" is 8.
inline std::string name_of_system(std::size_t system) { return std::string(kSystemNames[system]); }

inline std::optional<std::size_t> find_system(std::string_view name) {
    const auto found = std::ranges::find(kSystemNames, name);
    if (found == kSystemNames.end()) { return std::nullopt; }
    return static_cast<std::size_t>(found - kSystemNames.begin());
}

}  // namespace lockstep
