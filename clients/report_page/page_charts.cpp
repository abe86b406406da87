#include "clients/report_page/page_charts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "clients/analysis/channel_curves.hpp"
#include "clients/analysis/curves.hpp"
#include "clients/analysis/plane_path.hpp"
#include "clients/drawing/chart_number.hpp"

namespace lockstep::analysis {
namespace {

using nlohmann::json;

/// A list of numbers as JSON, as the page has a million of them. A number that is not finite is null.
std::string numbers(const std::vector<double>& values) {
    std::string list = "[";
    for (const double value : values) {
        std::isfinite(value) ? drawing::append_chart_number(list, value) : void(list += "null");
        list += ',';
    }
    if (list.back() == ',') { list.pop_back(); }
    return list += ']';
}

std::string text(std::string_view of) { return json(of).dump(); }

/// "[a,b]"
std::string joined(const std::vector<std::string>& parts) { return fmt::format("[{}]", fmt::join(parts, ",")); }

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

std::string row_of(const Kind& kind, const drawing::AxisCurve& curve, std::size_t colour) {
    std::vector<std::string> missing;
    for (const drawing::Span& span : curve.missing) { missing.push_back(numbers({span.from, span.to})); }
    const auto limits = curve.limit ? std::vector<double>{-*curve.limit, *curve.limit} : std::vector<double>{};
    return fmt::format(
        R"({{"kind":{},"name":{},"what":{},"unit":{},"colour":{},"limits":{},"missing":{},"x":{},"y":{}}})",
        text(kind.name), text(curve.axis), text(kind.what), text(curve.unit + std::string(kind.per)), colour,
        numbers(limits), joined(missing), numbers(curve.time_s), numbers(curve.value));
}

std::string words_of(const ChannelCurve& channel) {
    std::vector<std::string> words;
    for (std::size_t i = 0; i < channel.asked.size(); ++i) {
        words.push_back(fmt::format(R"({{"at_s":{},"what":{}}})", channel.asked_s[i], text(channel.asked[i])));
    }
    return joined(words);
}

std::string row_of(const ChannelCurve& channel, std::size_t colour) {
    const drawing::AxisCurve& curve = channel.curve;
    std::vector<std::string> missing;
    for (const drawing::Span& span : curve.missing) { missing.push_back(numbers({span.from, span.to})); }
    const std::string levels = channel.levels ? json(*channel.levels).dump() : "null";
    return fmt::format(
        R"({{"kind":"outputs","name":{},"what":{},"unit":{},"colour":{},"limits":[],"missing":{},"filled":true,)"
        R"("levels":{},"words":{},"x":{},"y":{}}})",
        text(curve.axis), text(channel.levels ? "" : "% of full scale"), text(curve.unit), colour, joined(missing),
        levels, words_of(channel), numbers(curve.time_s), numbers(curve.value));
}

std::string rows(const Analysis& analysis) {
    std::vector<std::string> list;
    for (const Kind& kind : kinds(analysis)) {
        for (std::size_t i = 0; i < kind.curves.size(); ++i) {
            if (!kind.curves[i].time_s.empty()) { list.push_back(row_of(kind, kind.curves[i], i)); }
        }
    }
    const auto channels = channel_curves(analysis);
    for (std::size_t i = 0; i < channels.size(); ++i) { list.push_back(row_of(channels[i], i)); }
    return joined(list);
}

std::string way(const drawing::PlanePath& path) {
    return fmt::format(R"({{"x":{},"y":{}}})", numbers(path.x), numbers(path.y));
}

std::string path(const Analysis& analysis) {
    const auto paths = paths_in_plane(analysis);
    if (!paths || paths->stepped.x.empty()) { return "null"; }
    return fmt::format(R"({{"asked":{},"stepped":{}}})", way(paths->asked), way(paths->stepped));
}

/// "0", "1", "2 - 3", ... in microseconds.
std::string class_text(const Analysis& analysis, std::size_t number) {
    const double high = analysis.microseconds(TickHistogram::most_in(number));
    if (number < 2) { return fmt::format("{:g}", high); }
    const double low = analysis.microseconds(TickHistogram::most_in(number - 1) + Ticks{1});
    return number + 1 == TickHistogram::kClasses ? fmt::format("{:g} or more", low)
                                                 : fmt::format("{:g} - {:g}", low, high);
}

/// Pairs of a number and how many of it follow each other.
json run_lengths(const std::vector<int>& numbers) {
    json list = json::array();
    for (auto from = numbers.begin(); from != numbers.end();) {
        const auto to = std::find_if(from, numbers.end(), [&](int number) { return number != *from; });
        list.push_back(*from);
        list.push_back(to - from);
        from = to;
    }
    return list;
}

json power_of(const PowerMap& map) {
    constexpr int kLevels = 100;
    const auto picture = [&](const PowerGrid& grid, PowerShades::Quantity quantity) {
        return run_lengths(shades(map, grid, quantity, kLevels).numbers);
    };
    json maps = json::array();
    for (const auto& [quantity, name, unit] :
         {std::tuple{PowerShades::Quantity::Power, "power", std::string("100 %: full scale")},
          std::tuple{PowerShades::Quantity::Energy, "energy for each mm",
                     fmt::format("100 %: {:.3g} ms of full power", 1e3 * map.most_energy)}}) {
        maps.push_back({{"name", name},
                        {"unit", unit},
                        {"asked", picture(map.asked, quantity)},
                        {"made", picture(map.made, quantity)}});
    }
    const CellBounds& bounds = map.asked.bounds();
    return {{"output", map.output},    {"summary", map.summary()},      {"cell_mm", map.asked.cell_mm()},
            {"left", bounds.left},     {"bottom", bounds.bottom},       {"width", bounds.width},
            {"height", bounds.height}, {"unknown", map.unknown_mm > 0}, {"maps", maps}};
}

json powers(const Analysis& analysis) {
    json list = json::array();
    for (const PowerMap& map : analysis.power_maps) { list.push_back(power_of(map)); }
    return list;
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
    return fmt::format(R"({{"whole":{},"rows":{},"path":{},"powers":{},"step_times":{}}})",
                       numbers({0, shown_seconds(analysis)}), rows(analysis), path(analysis), powers(analysis).dump(),
                       step_times(analysis).dump());
}

}  // namespace lockstep::analysis
