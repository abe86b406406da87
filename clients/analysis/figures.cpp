#include "clients/analysis/figures.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>

#include "clients/analysis/words.hpp"
#include "clients/drawing/motion_figures.hpp"

namespace lockstep::analysis {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// An axis's curve without its points yet, and how its ticks and steps become seconds and lengths.
struct Scaled {
    drawing::AxisCurve curve;
    double length_per_step = 1;
    double ticks_per_s = 1;
    Tick origin;

    double seconds(Tick tick) const { return static_cast<double>((tick - origin).value) / ticks_per_s; }
    void add(Tick tick, double value) {
        curve.time_s.push_back(seconds(tick));
        curve.value.push_back(value);
    }
};

Scaled scaled(const Analysis& analysis, const AxisLog& axis) {
    const auto steps_per_mm = analysis.steps_per_mm(axis);
    Scaled out{.origin = analysis.first_tick().value_or(Tick{})};
    out.curve.axis = axis.name();
    out.curve.unit = steps_per_mm ? "mm" : "steps";
    out.length_per_step = steps_per_mm ? 1 / *steps_per_mm : 1;
    out.ticks_per_s = 1e9 / static_cast<double>(analysis.tick_ns());
    for (const Break& what : axis.statistics().breaks()) {
        if (what.missing_batches == 0 || !what.from || !what.to) { continue; }
        out.curve.missing.push_back({out.seconds(*what.from), out.seconds(*what.to)});
    }
    return out;
}

/// Both curves go from the first step of any axis to the last: an axis rests before its own first and after its last.
drawing::AxisCurve speed_curve(const Analysis& analysis, const AxisLog& axis) {
    Scaled out = scaled(analysis, axis);
    if (const AxisConfig* config = analysis.axis_config(axis.name())) { out.curve.limit = config->max_velocity_mm_s; }
    if (!axis.statistics().first()) { return std::move(out.curve); }
    out.add(*analysis.first_tick(), 0);
    std::size_t next_gap = 0;
    for (const Sample& sample : axis.statistics().speed()) {
        const auto& gaps = out.curve.missing;
        for (; next_gap < gaps.size() && gaps[next_gap].from <= out.seconds(sample.at); ++next_gap) {
            out.add(sample.at, kNone);
        }
        out.add(sample.at, sample.value * out.ticks_per_s * out.length_per_step);
    }
    out.add(*analysis.last_tick(), 0);
    return std::move(out.curve);
}

drawing::AxisCurve position_curve(const Analysis& analysis, const AxisLog& axis) {
    Scaled out = scaled(analysis, axis);
    if (!axis.statistics().first()) { return std::move(out.curve); }
    const auto& knots = axis.trace().knots();
    out.add(*analysis.first_tick(), knots.front().position_steps * out.length_per_step);
    for (std::size_t i = 0; i < knots.size(); ++i) {
        if (i > 0 && !knots[i].joined) { out.add(knots[i].tick, kNone); }
        out.add(knots[i].tick, knots[i].position_steps * out.length_per_step);
    }
    out.add(*analysis.last_tick(), knots.back().position_steps * out.length_per_step);
    return std::move(out.curve);
}

std::vector<drawing::AxisCurve> curves(const Analysis& analysis,
                                       drawing::AxisCurve (*of)(const Analysis&, const AxisLog&)) {
    std::vector<drawing::AxisCurve> all;
    for (const auto& axis : analysis.axes) { all.push_back(of(analysis, *axis)); }
    return all;
}

std::string title(const Analysis& analysis, const std::string& what) { return analysis.machine + ": " + what; }

std::expected<void, std::string> write_file(const std::filesystem::path& path, const std::string& text) {
    errno = 0;
    std::ofstream out(path, std::ios::binary | std::ios::trunc);
    out << text;
    out.close();
    if (!out) { return std::unexpected(path.string() + ": cannot be written: " + std::strerror(errno)); }
    return {};
}

}  // namespace

drawing::Figure speed_figure(const Analysis& analysis) {
    return drawing::speed_figure(title(analysis, "speed of each axis"), in_a_line(analysis),
                                 curves(analysis, speed_curve));
}

drawing::Figure position_figure(const Analysis& analysis) {
    return drawing::position_figure(title(analysis, "position of each axis"), in_a_line(analysis),
                                    curves(analysis, position_curve));
}

drawing::Figure path_figure(const Analysis& analysis, const std::optional<PlanePaths>& plane) {
    if (!plane) { return position_figure(analysis); }
    std::string subtitle = in_a_line(analysis);
    if (analysis.largest_distance_mm) {
        subtitle = fmt::format("stepped is at most {:.4f} mm from asked · ", *analysis.largest_distance_mm) + subtitle;
    }
    return drawing::path_figure(title(analysis, "path in the X\u2013Y plane"), subtitle, {}, plane->asked,
                                plane->stepped);
}

std::expected<void, std::string> write_figures(const Analysis& analysis, const std::optional<PlanePaths>& plane,
                                               const std::filesystem::path& directory) {
    for (const auto& [name, figure] :
         {std::pair{"speed.svg", speed_figure(analysis)}, std::pair{"position.svg", position_figure(analysis)},
          std::pair{"xy.svg", path_figure(analysis, plane)}}) {
        if (auto written = write_file(directory / name, drawing::to_svg(figure)); !written) { return written; }
    }
    return {};
}

}  // namespace lockstep::analysis
