#include "clients/drawing/motion_figures.hpp"

#include <utility>

namespace lockstep::drawing {
namespace {

Figure over_time(std::string title, std::string subtitle) {
    Figure figure;
    figure.title = std::move(title);
    figure.subtitle = std::move(subtitle);
    figure.x_label = "time, s";
    figure.span_label = "steps missing from the log";
    return figure;
}

Chart row(const AxisCurve& curve, std::size_t place, std::string label) {
    Chart chart;
    chart.title = curve.axis;
    chart.y_label = std::move(label);
    chart.series.push_back({.x = curve.time_s, .y = curve.value, .stroke = {.colour = palette::series(place)}});
    chart.spans = curve.missing;
    return chart;
}

/// The number in short form: "150", "12.5".
std::string short_number(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) { text.pop_back(); }
    return text;
}

std::vector<Level> limit_levels(const AxisCurve& curve) {
    if (!curve.limit) { return {}; }
    return {{*curve.limit, "limit " + short_number(*curve.limit) + " " + curve.unit + "/s"}, {-*curve.limit, ""}};
}

Series path(std::string label, const PlanePath& points, Stroke stroke) {
    return {.label = std::move(label), .x = points.x, .y = points.y, .stroke = std::move(stroke)};
}

}  // namespace

Figure speed_figure(std::string title, std::string subtitle, const std::vector<AxisCurve>& axes) {
    Figure figure = over_time(std::move(title), std::move(subtitle));
    for (std::size_t i = 0; i < axes.size(); ++i) {
        figure.rows.push_back(row(axes[i], i, "speed, " + axes[i].unit + "/s"));
        figure.rows.back().levels = limit_levels(axes[i]);
    }
    return figure;
}

Figure position_figure(std::string title, std::string subtitle, const std::vector<AxisCurve>& axes) {
    Figure figure = over_time(std::move(title), std::move(subtitle));
    for (std::size_t i = 0; i < axes.size(); ++i) {
        figure.rows.push_back(row(axes[i], i, "position, " + axes[i].unit));
    }
    return figure;
}

Figure path_figure(std::string title, std::string subtitle, const Plane& plane, const PlanePath& asked,
                   const PlanePath& stepped) {
    const PlanePath& first = asked.x.empty() ? stepped : asked;
    Chart chart;
    chart.y_label = plane.y + ", " + plane.unit;
    if (!stepped.x.empty()) {
        chart.series.push_back(
            path("stepped path", stepped, {.colour = palette::series(0), .width = 5, .opacity = 0.45}));
    }
    if (!asked.x.empty()) { chart.series.push_back(path("commanded path", asked, {.width = 1.1})); }
    if (!first.x.empty()) { chart.marks.push_back({first.x.front(), first.y.front(), "start"}); }
    Figure figure;
    figure.title = std::move(title);
    figure.subtitle = std::move(subtitle);
    figure.x_label = plane.x + ", " + plane.unit;
    figure.rows.push_back(std::move(chart));
    figure.equal_aspect = true;
    return figure;
}

}  // namespace lockstep::drawing
