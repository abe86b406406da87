#include "clients/drawing/figure.hpp"

#include <algorithm>
#include <cmath>

#include "clients/drawing/decimate.hpp"
#include "clients/drawing/layout.hpp"
#include "clients/drawing/svg.hpp"

namespace lockstep::drawing {
namespace {

using Lines = std::vector<std::vector<Point>>;

constexpr double kPathTolerance = 0.2;  // pixels
constexpr double kSpanOpacity = 0.16;
constexpr double kFillOpacity = 0.25;

const Stroke kGridStroke{.colour = std::string(palette::kGrid), .width = 1};
const Stroke kFrameStroke{.colour = std::string(palette::kFrame), .width = 1};
const Stroke kLevelStroke{.colour = std::string(palette::kAlarm), .width = 1, .opacity = 0.7, .dashed = true};

TextStyle anchored(TextStyle style, Anchor anchor) {
    style.anchor = anchor;
    return style;
}

/// The curve in pixels, split where a value is not finite.
Lines unbroken(const Series& series, const Panel& panel) {
    Lines lines(1);
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
        if (std::isfinite(series.x[i]) && std::isfinite(series.y[i])) {
            lines.back().push_back(panel.at(series.x[i], series.y[i]));
        } else if (!lines.back().empty()) {
            lines.emplace_back();
        }
    }
    if (lines.back().empty()) { lines.pop_back(); }
    return lines;
}

std::vector<Point> decimated(const std::vector<Point>& line) {
    const bool rising = std::ranges::is_sorted(line, {}, &Point::x);
    return decimate_path(rising ? decimate_columns(line) : line, kPathTolerance);
}

/// Fills from the lines to `ground`.
void fill(Svg& svg, Lines lines, double ground, std::string_view colour) {
    for (auto& line : lines) {
        const Point first = line.front();
        line.push_back({line.back().x, ground});
        line.push_back({first.x, ground});
    }
    svg.area(lines, colour, kFillOpacity);
}

void draw_series(Svg& svg, const Series& series, const Panel& panel) {
    Lines lines = unbroken(series, panel);
    if (lines.empty()) { return; }
    for (auto& line : lines) { line = decimated(line); }
    if (series.filled) { fill(svg, lines, panel.up(0), series.stroke.colour); }
    svg.path(lines, series.stroke);
}

void draw_grid(Svg& svg, const Panel& panel, bool with_x_labels) {
    const Box& box = panel.box;
    for (const AxisTick& tick : panel.x_ticks) {
        const double x = panel.across(tick.value);
        svg.line({x, box.y}, {x, box.bottom()}, kGridStroke);
        if (with_x_labels) { svg.text({x, box.bottom() + 17}, tick.label, anchored(kLabelText, Anchor::Middle)); }
    }
    for (const AxisTick& tick : panel.y_ticks) {
        const double y = panel.up(tick.value);
        svg.line({box.x, y}, {box.right(), y}, tick.value == 0 ? kFrameStroke : kGridStroke);
        svg.text({box.x - 7, y + 4}, tick.label, anchored(kLabelText, Anchor::End));
    }
    svg.line({box.x, box.y}, {box.x, box.bottom()}, kFrameStroke);
    svg.line({box.x, box.bottom()}, {box.right(), box.bottom()}, kFrameStroke);
}

void draw_spans(Svg& svg, const Chart& chart, const Panel& panel) {
    for (const Span& span : chart.spans) {
        const double left = std::clamp(panel.across(span.from), panel.box.x, panel.box.right());
        const double right = std::clamp(panel.across(span.to), panel.box.x, panel.box.right());
        svg.rectangle({left, panel.box.y, std::max(1.5, right - left), panel.box.height}, palette::kAlarm,
                      kSpanOpacity);
    }
}

/// Draws one line for all moments within the same pixel.
void draw_moments(Svg& svg, const Chart& chart, const Panel& panel) {
    double last = panel.box.x - 1;
    for (const double moment : chart.moments.x) {
        const double x = panel.across(moment);
        if (moment < panel.x.low || moment > panel.x.high || x < last + 1) { continue; }
        svg.line({x, panel.box.y}, {x, panel.box.bottom()}, kMomentStroke);
        last = x;
    }
}

/// Writes the words that end before the next one begins.
void draw_words(Svg& svg, const Chart& chart, const Panel& panel) {
    TextStyle style = kLabelText;
    style.size = 10;
    style.halo = true;
    double free_from = panel.box.x;
    for (std::size_t i = 0; i < std::min(chart.moments.x.size(), chart.moments.words.size()); ++i) {
        const double x = panel.across(chart.moments.x[i]) + 3;
        const double end = x + text_width(chart.moments.words[i], style);
        if (x < free_from || end > panel.box.right()) { continue; }
        svg.text({x, panel.box.y + 10}, chart.moments.words[i], style);
        free_from = end + 4;
    }
}

void draw_levels(Svg& svg, const Chart& chart, const Panel& panel) {
    for (const Level& level : chart.levels) {
        if (level.y < panel.y.low || level.y > panel.y.high) { continue; }
        const double y = panel.up(level.y);
        svg.line({panel.box.x, y}, {panel.box.right(), y}, kLevelStroke);
    }
}

/// The labels of the dashed lines, above the chart's right end, where no curve crosses the text.
void draw_level_labels(Svg& svg, const Chart& chart, const Panel& panel) {
    std::string words;
    for (const Level& level : chart.levels) {
        if (level.label.empty()) { continue; }
        words += (words.empty() ? "" : " · ") + level.label;
    }
    if (words.empty()) { return; }
    TextStyle style = anchored(kLabelText, Anchor::End);
    style.colour = palette::kAlarm;
    const double y = panel.box.y - 8;
    const double left = panel.box.right() - text_width(words, style) - 6;
    svg.line({left - kSwatchWidth, y - 4}, {left, y - 4}, kLevelStroke);
    svg.text({panel.box.right(), y}, words, style);
}

/// The text is to the right of the dot, or to its left if it would exceed the chart.
void draw_marks(Svg& svg, const Chart& chart, const Panel& panel) {
    for (const Mark& mark : chart.marks) {
        const Point at = panel.at(mark.x, mark.y);
        TextStyle style = kLabelText;
        style.colour = mark.colour;
        style.halo = true;
        const bool fits = at.x + 9 + text_width(mark.label, style) < panel.box.right();
        style.anchor = fits ? Anchor::Start : Anchor::End;
        svg.dot(at, 4.5, mark.colour);
        svg.text({at.x + (fits ? 9 : -9), at.y - 7}, mark.label, style);
    }
}

void draw_row_title(Svg& svg, const Chart& chart, const Panel& panel) {
    const double y = panel.box.y - 8;
    svg.text({panel.box.x, y}, chart.title, kRowText);
    const double after = chart.title.empty() ? 0 : text_width(chart.title, kRowText) + 10;
    svg.text({panel.box.x + after, y}, chart.y_label, kLabelText);
}

void draw_row(Svg& svg, const Chart& chart, const Panel& panel, bool with_x_labels) {
    draw_row_title(svg, chart, panel);
    draw_level_labels(svg, chart, panel);
    draw_spans(svg, chart, panel);
    draw_grid(svg, panel, with_x_labels);
    draw_moments(svg, chart, panel);
    for (const Series& series : chart.series) { draw_series(svg, series, panel); }
    draw_levels(svg, chart, panel);
    draw_words(svg, chart, panel);
    draw_marks(svg, chart, panel);
}

void draw_legend(Svg& svg, const std::vector<LegendEntry>& legend) {
    for (const LegendEntry& entry : legend) {
        if (entry.area) {
            svg.rectangle({entry.at.x, entry.at.y - 6, kSwatchWidth, 12}, palette::kAlarm, kSpanOpacity);
        } else {
            svg.line(entry.at, {entry.at.x + kSwatchWidth, entry.at.y}, entry.stroke);
        }
        svg.text({entry.at.x + kSwatchWidth + 8, entry.at.y + 4}, entry.label, kLabelText);
    }
}

}  // namespace

std::string to_svg(const Figure& figure) {
    const Layout layout = arrange(figure);
    Svg svg(layout.width, layout.height, figure.title);
    svg.text({kMargin, kMargin + 14}, figure.title, kTitleText);
    if (!figure.subtitle.empty()) { svg.text({kMargin, kMargin + 35}, figure.subtitle, kSubtitleText); }
    draw_legend(svg, layout.legend);
    for (std::size_t i = 0; i < figure.rows.size(); ++i) {
        const bool lowest = i + 1 == figure.rows.size();
        draw_row(svg, figure.rows[i], layout.panels[i], lowest || figure.equal_aspect);
    }
    if (!layout.panels.empty()) {
        const Box& box = layout.panels.back().box;
        svg.text({box.x + box.width / 2, box.bottom() + 38}, figure.x_label, anchored(kLabelText, Anchor::Middle));
    }
    return std::move(svg).finish();
}

}  // namespace lockstep::drawing
