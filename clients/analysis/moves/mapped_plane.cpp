#include "clients/analysis/moves/mapped_plane.hpp"

#include <algorithm>

namespace lockstep::analysis {

std::optional<MappedPlane> mapped_plane(const MachineConfig& machine, const JobMoves& moves) {
    const auto x = machine.axis_named("X");
    const auto y = machine.axis_named("Y");
    const auto kinematics = moves.asked().places().kinematics();
    if (!moves.is_on_a_line() || kinematics->is_direct() || !x || !y) { return std::nullopt; }
    MappedPlane plane{.kinematics = kinematics, .x = *x, .y = *y};
    const auto scale = [&](AxisIndex axis) {
        return 1 / (machine.axes[axis].steps_per_mm * plane.kinematics->step_mm(axis));
    };
    plane.x_scale = scale(plane.x);
    plane.y_scale = scale(plane.y);
    const auto& starts = moves.asked().starts().steps;
    plane.counts.assign(starts.begin(), starts.end());
    return plane;
}

}  // namespace lockstep::analysis
