#include "clients/drawing/layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lockstep::drawing {
namespace {

constexpr double kWidth = 960;
constexpr double kMaxEqualHeight = 640;
constexpr double kMinSide = 220;    // of a chart of equal aspect
constexpr double kEqualTicks = 60;  // pixels between ticks, in both directions
constexpr double kRowTitleHeight = 24;
constexpr double kAxisRoom = 80;  // for a chart of equal aspect: the labels at its left, and the margin
constexpr double kRowGap = 14;
constexpr double kFootHeight = 52;
constexpr double kLegendHeight = 22;

/// The finite values' range.
class Extent {
public:
    void add(double value) {
        if (!std::isfinite(value)) { return; }
        low_ = std::min(low_, value);
        high_ = std::max(high_, value);
    }
    /// The range, widened on each side by its length times `margin`; a single value is widened by a tenth of itself.
    Range range(double margin) const {
        if (low_ > high_) { return {0, 1}; }
        const double smallest = std::max(std::abs(low_), std::abs(high_)) * 1e-9;
        if (high_ - low_ > smallest) {
            const double more = (high_ - low_) * margin;
            return {low_ - more, high_ + more};
        }
        const double half = low_ == 0 ? 1 : std::abs(low_) * 0.1;
        return {low_ - half, high_ + half};
    }

private:
    double low_ = std::numeric_limits<double>::infinity();
    double high_ = -std::numeric_limits<double>::infinity();
};

Range x_range(const Figure& figure, double margin) {
    Extent extent;
    for (const Chart& chart : figure.rows) {
        for (const Series& series : chart.series) {
            for (const double x : series.x) { extent.add(x); }
        }
    }
    return extent.range(margin);
}

Range y_range(const Chart& chart) {
    Extent extent;
    for (const Series& series : chart.series) {
        for (const double y : series.y) { extent.add(y); }
        if (series.filled) { extent.add(0); }
    }
    if (!chart.names.empty()) { extent.add(static_cast<double>(chart.names.size() - 1)); }
    return extent.range(chart.names.empty() ? 0.06 : 0.2);
}

double row_height(std::size_t rows) { return rows <= 1 ? 400 : (rows <= 3 ? 190 : 130); }

/// Distinct labels in the order they first appear, laid out in lines below the title.
std::vector<LegendEntry> legend_entries(const Figure& figure) {
    std::vector<LegendEntry> entries;
    const auto add = [&](const std::string& label, const Stroke& stroke, bool area) {
        const bool known = std::ranges::find(entries, label, &LegendEntry::label) != entries.end();
        if (!label.empty() && !known) { entries.push_back({{}, label, stroke, area}); }
    };
    for (const Chart& chart : figure.rows) {
        for (const Series& series : chart.series) { add(series.label, series.stroke, false); }
        if (!chart.spans.empty()) { add(figure.span_label, {}, true); }
        if (!chart.moments.x.empty()) { add(chart.moments.label, kMomentStroke, false); }
    }
    return entries;
}

/// Places the entries from `top` on and returns where they end.
double place_legend(std::vector<LegendEntry>& entries, double width, double top) {
    if (entries.empty()) { return top; }
    double x = kMargin;
    for (LegendEntry& entry : entries) {
        const double wide = kSwatchWidth + 8 + text_width(entry.label, kLabelText) + 18;
        if (x > kMargin && x + wide > width - kMargin) {
            x = kMargin;
            top += kLegendHeight;
        }
        entry.at = {x, top + kLegendHeight / 2};
        x += wide;
    }
    return top + kLegendHeight;
}

double widest(const std::vector<AxisTick>& ticks) {
    double width = 0;
    for (const AxisTick& tick : ticks) { width = std::max(width, text_width(tick.label, kLabelText)); }
    return width;
}

int wanted_ticks(double pixels, double apart) { return std::max(2, static_cast<int>(pixels / apart)); }

/// Widens both ranges around their middles so that a unit has the same length in both directions. Makes the box as
/// small as the data allow.
void equalise(Panel& panel) {
    const double room = panel.box.width;
    const double scale = std::min(room / panel.x.span(), kMaxEqualHeight / panel.y.span());  // pixels per unit
    panel.box.width = std::clamp(panel.x.span() * scale, std::min(room, 1.5 * kMinSide), room);
    panel.box.height = std::clamp(panel.y.span() * scale, kMinSide, kMaxEqualHeight);
    const auto widened = [scale](Range range, double pixels) {
        return Range{range.middle() - pixels / scale / 2, range.middle() + pixels / scale / 2};
    };
    panel.x = widened(panel.x, panel.box.width);
    panel.y = widened(panel.y, panel.box.height);
}

std::vector<AxisTick> y_ticks(const Chart& chart, const Panel& panel, bool equal_aspect) {
    if (chart.names.empty()) {
        return round_ticks(panel.y, wanted_ticks(panel.box.height, equal_aspect ? kEqualTicks : 42));
    }
    std::vector<AxisTick> named;
    for (std::size_t i = 0; i < chart.names.size(); ++i) { named.push_back({static_cast<double>(i), chart.names[i]}); }
    return named;
}

std::vector<Panel> size_panels(const Figure& figure) {
    std::vector<Panel> panels;
    const Range x = x_range(figure, figure.equal_aspect ? 0.05 : 0);
    for (const Chart& chart : figure.rows) {
        Panel panel{
            .box = {0, 0, kWidth - kAxisRoom - kMargin, row_height(figure.rows.size())}, .x = x, .y = y_range(chart)};
        if (figure.equal_aspect) { equalise(panel); }
        panel.y_ticks = y_ticks(chart, panel, figure.equal_aspect);
        panels.push_back(std::move(panel));
    }
    return panels;
}

/// Puts the panels below each other, with room for the widest label at their left. Returns where they end.
double stack(std::vector<Panel>& panels, double top, bool equal_aspect) {
    double labels = 0;
    for (const Panel& panel : panels) { labels = std::max(labels, widest(panel.y_ticks)); }
    const double left = kMargin + labels + 8;
    for (Panel& panel : panels) {
        panel.box.x = left;
        panel.box.y = top + kRowTitleHeight;
        if (!equal_aspect) { panel.box.width = kWidth - left - kMargin - 8; }
        panel.x_ticks = round_ticks(panel.x, wanted_ticks(panel.box.width, equal_aspect ? kEqualTicks : 95));
        top = panel.box.bottom() + kRowGap;
    }
    return top - kRowGap;
}

/// The width that the widest part requires, at most kWidth.
double width_of(const Figure& figure, const std::vector<Panel>& panels) {
    double width = std::max(text_width(figure.title, kTitleText), text_width(figure.subtitle, kSubtitleText)) + kMargin;
    for (const Panel& panel : panels) { width = std::max(width, kAxisRoom + panel.box.width); }
    return std::min(kWidth, width + kMargin);
}

}  // namespace

Layout arrange(const Figure& figure) {
    Layout layout{.legend = legend_entries(figure), .panels = size_panels(figure)};
    layout.width = figure.equal_aspect ? width_of(figure, layout.panels) : kWidth;
    double top = kMargin + 24 + (figure.subtitle.empty() ? 0 : 20);
    top = place_legend(layout.legend, layout.width, top) + 4;
    layout.height = stack(layout.panels, top, figure.equal_aspect) + kFootHeight;
    return layout;
}

}  // namespace lockstep::drawing
