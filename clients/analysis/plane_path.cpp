#include "clients/analysis/plane_path.hpp"

#include <algorithm>
#include <limits>
#include <variant>

#include "core/arc_path.hpp"

namespace lockstep::analysis {
namespace {

constexpr double kChord_mm = 0.01;  // a chord is drawn so far from its arc at most

/// Steps per mm of an axis that has made steps.
std::optional<double> scale_of(const Analysis& analysis, const std::string& name) {
    for (const auto& log : analysis.axes) {
        if (log->name() == name && log->statistics().first()) { return analysis.steps_per_mm(*log); }
    }
    return std::nullopt;
}

/// Lengths along each axis are divided by its scale.
drawing::PlanePath joined(const std::vector<std::vector<drawing::Point>>& ways, double scale_x, double scale_y) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    drawing::PlanePath path;
    for (const auto& way : ways) {
        if (!path.x.empty()) {
            path.x.push_back(kNone);
            path.y.push_back(kNone);
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

std::vector<drawing::Point> asked_in_plane(const Program& program) {
    const auto x = static_cast<std::size_t>(std::ranges::find(program.axes, "X") - program.axes.begin());
    const auto y = static_cast<std::size_t>(std::ranges::find(program.axes, "Y") - program.axes.begin());
    if (x == program.axes.size() || y == program.axes.size()) { return {}; }
    std::vector<drawing::Point> points = {{program.start_mm.at(x), program.start_mm.at(y)}};
    std::vector<double> at = program.start_mm;
    for (const Block& block : program.blocks) {
        if (const auto* move = std::get_if<ProgramMove>(&block.action)) {
            each_chord(*move, at, kChord_mm, [&](const std::vector<double>& to) {
                points.push_back({to.at(x), to.at(y)});
            });
            at = move->target_mm;
        }
    }
    return points;
}

}  // namespace lockstep::analysis
