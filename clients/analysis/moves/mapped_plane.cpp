#include "clients/analysis/moves/mapped_plane.hpp"

#include <algorithm>

namespace lockstep::analysis {

std::optional<MappedPlane> mapped_plane(const MachineConfig& machine, const JobMoves& moves) {
    const auto place = [&](const char* name) {
        const auto found = std::ranges::find(machine.axes, name, &AxisConfig::name);
        return static_cast<std::size_t>(found - machine.axes.begin());
    };
    MappedPlane plane{.kinematics = moves.asked().places().kinematics(), .x = place("X"), .y = place("Y")};
    const bool has_axes = std::max(plane.x, plane.y) < machine.axes.size();
    if (!moves.is_on_a_line() || plane.kinematics->is_direct() || !has_axes) { return std::nullopt; }
    const auto scale = [&](std::size_t axis) {
        return 1 / (machine.axes[axis].steps_per_mm * plane.kinematics->step_mm(axis));
    };
    plane.x_scale = scale(plane.x);
    plane.y_scale = scale(plane.y);
    const auto& starts = moves.asked().starts().steps;
    plane.counts.assign(starts.begin(), starts.end());
    return plane;
}

}  // namespace lockstep::analysis
