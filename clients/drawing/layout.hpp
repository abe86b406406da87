// The layout of a figure in pixels, and the range of data in each chart.
#pragma once

#include <string>
#include <vector>

#include "clients/drawing/figure.hpp"
#include "clients/drawing/round_ticks.hpp"
#include "clients/drawing/svg.hpp"

namespace lockstep::drawing {

inline constexpr TextStyle kTitleText{.size = 17, .bold = true};
inline constexpr TextStyle kSubtitleText{.size = 12.5, .colour = palette::kSoftInk};
inline constexpr TextStyle kRowText{.size = 13, .bold = true};
inline constexpr TextStyle kLabelText{.size = 12, .colour = palette::kSoftInk};
inline const Stroke kMomentStroke{.colour = std::string(palette::kSoftInk), .width = 1, .opacity = 0.6};
inline constexpr double kMargin = 20;
inline constexpr double kSwatchWidth = 26;

/// One chart's area and the map from its data to pixels.
struct Panel {
    Box box;
    Range x;
    Range y;
    std::vector<AxisTick> x_ticks;
    std::vector<AxisTick> y_ticks;

    double across(double value) const { return box.x + (value - x.low) / x.span() * box.width; }
    double up(double value) const { return box.bottom() - (value - y.low) / y.span() * box.height; }
    Point at(double px, double py) const { return {across(px), up(py)}; }
};

struct LegendEntry {
    Point at;  // the swatch's left end, at the middle of its height
    std::string label;
    Stroke stroke;
    bool area = false;  // a span
};

struct Layout {
    double width = 0;
    double height = 0;
    std::vector<LegendEntry> legend;
    std::vector<Panel> panels;  // one per row
};

Layout arrange(const Figure& figure);

}  // namespace lockstep::drawing
