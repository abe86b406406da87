#include "clients/report_page/page_charts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <vector>

#include "clients/analysis/curves.hpp"
#include "clients/analysis/plane_path.hpp"

namespace lockstep::analysis {
namespace {

using nlohmann::json;

/// With nine digits, as many as a chart can show.
json number(double value) {
    if (!std::isfinite(value)) { return nullptr; }
    return std::strtod(fmt::format("{:.9g}", value).c_str(), nullptr);
}

json numbers(const std::vector<double>& values) {
    json list = json::array();
    for (const double value : values) { list.push_back(number(value)); }
    return list;
}

struct Kind {
    std::string_view name;  // of the button
    std::string_view what;  // beside an axis's name
    std::string_view per;   // behind the unit of length
    std::vector<drawing::AxisCurve> curves;
};

std::vector<Kind> kinds(const Analysis& analysis) {
    return {{"speed", "speed", "/s", speed_curves(analysis)},
            {"acceleration", "acceleration", "/s\u00b2", acceleration_curves(analysis)},
            {"position", "position", "", position_curves(analysis)},
            {"step time error", "lateness of its steps against the commanded ticks", "", lateness_curves(analysis)},
            {"slack", "slack: how long before its start the latest frame came", "", slack_curves(analysis)}};
}

json row_of(const Kind& kind, const drawing::AxisCurve& curve, std::size_t colour) {
    json missing = json::array();
    for (const drawing::Span& span : curve.missing) { missing.push_back(numbers({span.from, span.to})); }
    return {{"kind", kind.name},
            {"name", curve.axis},
            {"what", kind.what},
            {"unit", curve.unit + std::string(kind.per)},
            {"colour", colour},
            {"limits", numbers(curve.limit ? std::vector<double>{-*curve.limit, *curve.limit} : std::vector<double>{})},
            {"missing", missing},
            {"x", numbers(curve.time_s)},
            {"y", numbers(curve.value)}};
}

json rows(const Analysis& analysis) {
    json list = json::array();
    for (const Kind& kind : kinds(analysis)) {
        for (std::size_t i = 0; i < kind.curves.size(); ++i) {
            if (!kind.curves[i].time_s.empty()) { list.push_back(row_of(kind, kind.curves[i], i)); }
        }
    }
    return list;
}

json way(const drawing::PlanePath& path) { return {{"x", numbers(path.x)}, {"y", numbers(path.y)}}; }

json path(const Analysis& analysis) {
    const auto paths = paths_in_plane(analysis);
    if (!paths || paths->stepped.x.empty()) { return nullptr; }
    return {{"asked", way(paths->asked)}, {"stepped", way(paths->stepped)}};
}

/// "0", "1", "2 - 3", ... in microseconds.
std::string class_text(const Analysis& analysis, std::size_t number) {
    const double high = analysis.microseconds(TickHistogram::most_in(number));
    if (number < 2) { return fmt::format("{:g}", high); }
    const double low = analysis.microseconds(TickHistogram::most_in(number - 1) + Ticks{1});
    return number + 1 == TickHistogram::kClasses ? fmt::format("{:g} or more", low)
                                                 : fmt::format("{:g} - {:g}", low, high);
}

json step_times(const Analysis& analysis) {
    json classes = json::array();
    for (std::size_t i = 0; i < TickHistogram::kClasses; ++i) { classes.push_back(class_text(analysis, i)); }
    json list = json::array();
    for (std::size_t i = 0; i < analysis.axes.size(); ++i) {
        const AxisLog& axis = *analysis.axes[i];
        if (axis.late().empty()) { continue; }
        list.push_back({{"name", axis.name()}, {"colour", i}, {"counts", axis.late().counts()}, {"classes", classes}});
    }
    return list;
}

}  // namespace

std::string page_charts(const Analysis& analysis) {
    const double lasts = analysis.first_tick() ? analysis.seconds(*analysis.last_tick() - *analysis.first_tick()) : 0;
    const json charts{{"whole", numbers({0, lasts})},
                      {"rows", rows(analysis)},
                      {"path", path(analysis)},
                      {"step_times", step_times(analysis)}};
    return charts.dump();
}

}  // namespace lockstep::analysis
