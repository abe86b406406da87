// Parses "X+ Y-" to the axes of a jog. Pure.
#pragma once

#include <expected>
#include <optional>
#include <string>
#include <vector>

#include "core/machine.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

struct JogOptions {
    std::vector<std::string> words;     // an axis's name, then + or -
    std::optional<double> speed_mm_s;   // default: usual_jog_speed
    std::optional<double> distance_mm;  // default: to the end of the travel
};

/// 10 mm/s, or the axis's maximum velocity if that is lower.
double usual_jog_speed(const AxisConfig& axis);

/// Fails if a word, a speed or a distance is not valid for the machine.
std::expected<std::vector<JogAxis>, std::string> jog_axes(const MachineConfig& machine, const JogOptions& options);

}  // namespace lockstep
