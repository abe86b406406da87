#include "clients/analysis/figures.hpp"

#include <fmt/format.h>

#include "clients/analysis/analysis_text.hpp"
#include "clients/analysis/curves.hpp"
#include "clients/analysis/moves/deviation.hpp"
#include "clients/drawing/motion_figures.hpp"
#include "services/files/text_file.hpp"

namespace lockstep::analysis {
namespace {

std::string title(const Analysis& analysis, const std::string& what) { return analysis.machine + ": " + what; }

std::string part(const Analysis& analysis) { return analysis.has_motors_as_axes() ? "axis" : "axis and motor"; }

/// Marks the events of programs in every row.
drawing::Figure with_events(const Analysis& analysis, drawing::Figure figure) {
    drawing::Moments moments{.x = {}, .label = "events of programs"};
    for (const HappenedEvent& event : analysis.program_events) { moments.x.push_back(analysis.seconds_at(event.at)); }
    for (drawing::Chart& row : figure.rows) { row.moments = moments; }
    return figure;
}

}  // namespace

drawing::Figure speed_figure(const Analysis& analysis) {
    return with_events(analysis, drawing::speed_figure(title(analysis, "speed of each " + part(analysis)),
                                                       in_a_line(analysis), speed_curves(analysis)));
}

drawing::Figure position_figure(const Analysis& analysis) {
    return with_events(analysis, drawing::position_figure(title(analysis, "position of each " + part(analysis)),
                                                          in_a_line(analysis), position_curves(analysis)));
}

drawing::Figure path_figure(const Analysis& analysis, const std::optional<PlanePaths>& plane) {
    if (!plane) { return position_figure(analysis); }
    std::string subtitle = in_a_line(analysis);
    Deviations distances;
    for (const JobLog& job : analysis.jobs) {
        if (!analysis.config) { break; }
        add(distances,
            deviations(*analysis.config, *analysis.kinematics, job.moves, job.move_count, job.largest_distance_mm));
    }
    if (!distances.empty()) {
        subtitle = fmt::format("stepped is at most {} from commanded · ", to_text(distances)) + subtitle;
    }
    return drawing::path_figure(title(analysis, "path in the X\u2013Y plane"), subtitle, {}, plane->asked,
                                plane->stepped);
}

std::expected<void, std::string> write_figures(const Analysis& analysis, const std::optional<PlanePaths>& plane,
                                               const std::filesystem::path& directory) {
    for (const auto& [name, figure] :
         {std::pair{"speed.svg", speed_figure(analysis)}, std::pair{"position.svg", position_figure(analysis)},
          std::pair{"xy.svg", path_figure(analysis, plane)}}) {
        if (auto written = write_text_file(directory / name, drawing::to_svg(figure)); !written) { return written; }
    }
    return {};
}

}  // namespace lockstep::analysis
