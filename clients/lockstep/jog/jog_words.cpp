#include "clients/lockstep/jog/jog_words.hpp"

#include <algorithm>
#include <cmath>

#include "clients/session/move_program.hpp"
#include "core/coordinator/jogs/jogs.hpp"
#include "core/number_text.hpp"

namespace lockstep {
namespace {

constexpr double kUsualSpeed_mm_s = 10;

std::expected<JogAxis, std::string> jog_axis(const MachineConfig& machine, const JogOptions& options,
                                             const std::string& word) {
    const char direction = word.empty() ? ' ' : word.back();
    if (word.size() < 2 || (direction != '+' && direction != '-')) {
        return std::unexpected("\"" + word + "\" is not an axis and a direction, such as X+ or Y-");
    }
    const auto axis = find_axis(machine, word.substr(0, word.size() - 1));
    if (!axis) { return std::unexpected(axis.error()); }
    const AxisConfig& config = machine.axes[*axis];
    const double speed = options.speed_mm_s.value_or(usual_jog_speed(config));
    if (!is_jog_speed(config, speed)) { return std::unexpected(jog_speed_text(config, speed)); }
    return JogAxis{.axis = *axis, .speed_mm_s = direction == '+' ? speed : -speed, .distance_mm = options.distance_mm};
}

}  // namespace

double usual_jog_speed(const AxisConfig& axis) { return std::min(kUsualSpeed_mm_s, axis.max_velocity_mm_s); }

std::expected<std::vector<JogAxis>, std::string> jog_axes(const MachineConfig& machine, const JogOptions& options) {
    if (options.distance_mm && !(*options.distance_mm > 0 && std::isfinite(*options.distance_mm))) {
        return std::unexpected("--distance " + short_number(*options.distance_mm) +
                               ": the distance must be above 0 mm");
    }
    std::vector<JogAxis> jogs;
    for (const std::string& word : options.words) {
        const auto jog = jog_axis(machine, options, word);
        if (!jog) { return std::unexpected(jog.error()); }
        if (std::ranges::find(jogs, jog->axis, &JogAxis::axis) != jogs.end()) {
            return std::unexpected("axis " + machine.axes[jog->axis].name + " is named twice");
        }
        jogs.push_back(*jog);
    }
    return jogs;
}

}  // namespace lockstep
