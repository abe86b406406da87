#include "clients/analysis/figures.hpp"

#include <fmt/format.h>

#include "clients/analysis/analysis_text.hpp"
#include "clients/analysis/channel_curves.hpp"
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

drawing::Chart row_of(const ChannelCurve& channel, const drawing::Figure& figure) {
    drawing::Chart chart;
    chart.title = channel.curve.axis;
    chart.y_label = channel.levels ? "" : "% of full scale";
    if (channel.levels) { chart.names = {channel.levels->begin(), channel.levels->end()}; }
    chart.series.push_back({.label = "",
                            .x = channel.curve.time_s,
                            .y = channel.curve.value,
                            .stroke = {.colour = drawing::palette::series(figure.rows.size())},
                            .filled = true});
    chart.spans = channel.curve.missing;
    chart.moments = {.x = channel.asked_s, .label = "words of programs that switch the output", .words = channel.asked};
    return chart;
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

drawing::Figure outputs_figure(const Analysis& analysis) {
    drawing::Figure figure;
    figure.title = title(analysis, "inputs and outputs");
    figure.subtitle = "a curve begins with the first change on record · " + in_a_line(analysis);
    figure.x_label = "time, s";
    figure.span_label = "not known: changes missing from the log";
    for (const ChannelCurve& channel : channel_curves(analysis)) { figure.rows.push_back(row_of(channel, figure)); }
    return figure;
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
    for (const PowerMap& map : analysis.power_maps) {
        const std::string name = analysis.power_maps.size() == 1 ? "power.svg" : "power-" + map.output + ".svg";
        const std::string svg = power_svg(map, title(analysis, "power of " + map.output));
        if (auto written = write_text_file(directory / name, svg); !written) { return written; }
    }
    if (analysis.channel_courses.empty()) { return {}; }
    return write_text_file(directory / "outputs.svg", drawing::to_svg(outputs_figure(analysis)));
}

}  // namespace lockstep::analysis
