// "X+ Y-" as the axes of a jog. Pure.
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
    std::optional<double> speed_mm_s;   // none: usual_jog_speed
    std::optional<double> distance_mm;  // none: to the end of the travel
};

/// 10 mm/s, or what the axis can do.
double usual_jog_speed(const AxisConfig& axis);

/// Error: a word, a speed or a distance that the machine does not have.
std::expected<std::vector<JogAxis>, std::string> jog_axes(const MachineConfig& machine, const JogOptions& options);

/// Where the jog ends by itself if the axis is homed, from where it stands.
std::int64_t jog_target(const AxisConfig& axis, const JogAxis& jog, std::int64_t here);

}  // namespace lockstep
