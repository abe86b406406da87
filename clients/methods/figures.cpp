#include "clients/methods/figures.hpp"

#include <cmath>
#include <utility>

#include "clients/methods/move_text.hpp"

namespace lockstep::comparison {
namespace {

using methods::LaiPulses;

constexpr std::int64_t kVisiblePulses = 8;  // per unit

drawing::Chart speed_chart(const Comparison& comparison) {
    drawing::Chart chart{.title = "speed", .y_label = "steps/s"};
    drawing::Series ideal{.label = "ideal", .stroke = {.width = 3, .opacity = 0.35}};
    for (const auto& corner : comparison.ideal) {
        ideal.x.push_back(corner.time_s);
        ideal.y.push_back(corner.steps_per_s);
    }
    chart.series.push_back(std::move(ideal));
    for (std::size_t i = 0; i < comparison.rows.size(); ++i) {
        const Row& row = comparison.rows[i];
        if (!row.outcome) { continue; }
        chart.series.push_back({.label = std::string(row.method.name),
                                .x = row.outcome->speed_time_s,
                                .y = row.outcome->speed,
                                .stroke = {.colour = drawing::palette::series(i), .width = 1.2}});
    }
    return chart;
}

/// The unit is ms if the error in us would need five digits.
drawing::Chart error_chart(const Row& row, std::size_t place) {
    const bool in_ms = std::abs(row.outcome->largest_error_us) >= 10'000;
    drawing::Chart chart{.title = "step time error of " + std::string(row.method.name), .y_label = in_ms ? "ms" : "µs"};
    drawing::Series series{.x = row.outcome->train.times_s,
                           .y = row.outcome->errors_us,
                           .stroke = {.colour = drawing::palette::series(place), .width = 1}};
    if (in_ms) {
        for (double& error : series.y) { error /= 1'000; }
    }
    chart.series.push_back(std::move(series));
    return chart;
}

drawing::Series line(std::int64_t from_x, const std::vector<methods::LaiPoint>& points, std::string colour) {
    drawing::Series series{.stroke = {.colour = std::move(colour), .width = 2.5, .opacity = 0.7}};
    for (const methods::LaiPoint& point : points) {
        series.x.push_back(static_cast<double>(from_x) + static_cast<double>(point.x) / kVisiblePulses);
        series.y.push_back(static_cast<double>(point.y) / kVisiblePulses);
    }
    return series;
}

drawing::Chart lines_chart(std::string title, LaiPulses how) {
    drawing::Chart chart{.title = std::move(title), .y_label = "y"};
    for (std::int64_t from_x = 0; from_x < kLines; ++from_x) {
        const auto colour = drawing::palette::series(static_cast<std::size_t>(from_x));
        chart.series.push_back(line(from_x, walk_line(from_x, kVisiblePulses, how), colour));
        chart.series.push_back({.label = "the straight line",
                                .x = {static_cast<double>(from_x), 5},
                                .y = {0, 5},
                                .stroke = {.width = 0.8}});
    }
    return chart;
}

}  // namespace

drawing::Figure comparison_figure(const Comparison& comparison) {
    drawing::Figure figure{
        .title = "One move, method by method", .subtitle = move_text(comparison.move), .x_label = "time, s"};
    figure.rows.push_back(speed_chart(comparison));
    for (std::size_t i = 0; i < comparison.rows.size(); ++i) {
        if (comparison.rows[i].outcome) { figure.rows.push_back(error_chart(comparison.rows[i], i)); }
    }
    return figure;
}

drawing::Figure lines_figure() {
    drawing::Figure figure{
        .title = "Six lines to (5, 5), pulse by pulse",
        .subtitle = "8 pulses to a unit, at most 4 per period; after Lai, Chien and Tsao, Figs. 14 and 15",
        .x_label = "x",
        .equal_aspect = true};
    figure.rows.push_back(lines_chart("without the DDA", LaiPulses::AtOnce));
    figure.rows.push_back(lines_chart("with the DDA", LaiPulses::Spread));
    return figure;
}

}  // namespace lockstep::comparison
