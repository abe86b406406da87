#include "clients/analysis/plane_path.hpp"

#include <algorithm>
#include <limits>
#include <variant>

#include "clients/drawing/thinned.hpp"
#include "core/arc_path.hpp"

namespace lockstep::analysis {
namespace {

constexpr double kChord_mm = 0.01;  // maximum distance of a drawn chord from its arc

/// The steps per mm of this axis in stepped_ways; nullopt if it has made no steps.
std::optional<double> scale_of(const Analysis& analysis, const std::string& name) {
    if (!analysis.has_motors_as_axes()) {
        const AxisConfig* axis = analysis.axis_config(name);
        if (axis == nullptr || !analysis.first_tick()) { return std::nullopt; }
        return 1 / analysis.kinematics->step_mm(*analysis.config->axis_named(name));
    }
    for (const auto& log : analysis.axes) {
        if (log->name() == name && log->statistics().first()) { return analysis.steps_per_mm(*log); }
    }
    return std::nullopt;
}

/// Joins the ways to one path with a break between them, and divides the lengths along each axis by its scale.
drawing::PlanePath joined(const std::vector<std::vector<drawing::Point>>& ways, double scale_x, double scale_y) {
    constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
    drawing::PlanePath path;
    for (const auto& way : ways) {
        if (!path.x.empty()) {
            path.x.push_back(kGap);
            path.y.push_back(kGap);
        }
        for (const drawing::Point& point : way) {
            path.x.push_back(point.x / scale_x);
            path.y.push_back(point.y / scale_y);
        }
    }
    return path;
}

}  // namespace

std::optional<PlanePaths> paths_in_plane(const Analysis& analysis) {
    const auto x = scale_of(analysis, "X");
    const auto y = scale_of(analysis, "Y");
    if (!x || !y) { return std::nullopt; }
    return PlanePaths{joined(analysis.asked_ways_mm, 1, 1), joined(analysis.stepped_ways, *x, *y)};
}

std::vector<drawing::Point> asked_in_plane(const RecordedProgram& program, std::size_t at_most) {
    const ProgramHead& head = program.head();
    const auto x = static_cast<std::size_t>(std::ranges::find(head.axes, "X") - head.axes.begin());
    const auto y = static_cast<std::size_t>(std::ranges::find(head.axes, "Y") - head.axes.begin());
    if (x == head.axes.size() || y == head.axes.size()) { return {}; }
    drawing::ThinnedPath path(at_most);
    path.add({head.start_mm.at(x), head.start_mm.at(y)});
    std::vector<double> at = head.start_mm;
    for (std::uint32_t number = 0; const Block* block = program.block(number); ++number) {
        const auto* move = std::get_if<ProgramMove>(&block->action);
        if (move == nullptr) { continue; }
        each_chord(*move, at, kChord_mm, [&](const std::vector<double>& to) { path.add({to.at(x), to.at(y)}); });
        at = move->target_mm;
    }
    return path.points();
}

}  // namespace lockstep::analysis
