// Rows of line charts over one shared x axis, as one self-contained SVG.
//
// Data are plain arrays in the units of their labels. A figure stays small for any input. A curve over a rising x keeps
// its first, lowest, highest and last value in every pixel column, so that no peak is lost. Any other path is thinned
// to within a fifth of a pixel.
#pragma once

#include <string>
#include <vector>

#include "clients/drawing/palette.hpp"

namespace lockstep::drawing {

struct Stroke {
    std::string colour{palette::kInk};  // as SVG writes it, "#1f77b4"
    double width = 1.5;                 // pixels
    double opacity = 1;
    bool dashed = false;
};

/// One curve. x and y have the same length. A value that is not finite breaks the curve.
struct Series {
    std::string label;  // appears once in the figure's legend; empty: not in the legend
    std::vector<double> x;
    std::vector<double> y;
    Stroke stroke;
    bool filled = false;  // down to 0, which is then in the chart's range
};

/// A named level across a chart, such as a limit. It is drawn if it is within the chart's range, and does not
/// widen it.
struct Level {
    double y = 0;
    std::string label;
};

/// A shaded range of x, such as one with missing data.
struct Span {
    double from = 0;
    double to = 0;
};

/// A dot with a text beside it.
struct Mark {
    double x = 0;
    double y = 0;
    std::string label;
    std::string colour{palette::kInk};
};

/// A thin line across a chart at each x within its range.
struct Moments {
    std::vector<double> x;           // rising
    std::string label;               // in the legend; empty: not in the legend
    std::vector<std::string> words;  // beside the lines where there is room; empty: none
};

struct Chart {
    std::string title;    // at its upper left: "X"
    std::string y_label;  // beside it, with the unit: "speed, mm/s"
    std::vector<Series> series;
    std::vector<std::string> names;  // of the values 0, 1, ... in place of numbers, if the chart has only these
    std::vector<Level> levels;
    std::vector<Span> spans;
    std::vector<Mark> marks;
    Moments moments;
};

/// `equal_aspect`: a millimetre has the same length in both directions.
struct Figure {
    std::string title;
    std::string subtitle;    // the figures that matter, in a line
    std::string x_label;     // with the unit: "time, s"
    std::string span_label;  // explains the spans in the legend, if there are any
    std::vector<Chart> rows;
    bool equal_aspect = false;
};

/// The figure as an SVG document. Without any finite value the axes range from 0 to 1.
std::string to_svg(const Figure& figure);

}  // namespace lockstep::drawing
