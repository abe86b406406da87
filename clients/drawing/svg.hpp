// Writes SVG, element by element. Lengths are pixels, y grows downwards, and colours are as SVG writes them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clients/drawing/figure.hpp"

namespace lockstep::drawing {

struct Point {
    double x = 0;
    double y = 0;
    bool operator==(const Point&) const = default;
};

struct Box {
    double x = 0;
    double y = 0;
    double width = 0;
    double height = 0;
    double right() const { return x + width; }
    double bottom() const { return y + height; }
};

enum class Anchor { Start, Middle, End };

struct TextStyle {
    double size = 12;
    std::string_view colour = palette::kInk;
    bool bold = false;
    bool halo = false;  // of paper colour, for text over curves
    Anchor anchor = Anchor::Start;
};

/// Writes the characters that XML reserves as entities, and those that it forbids as '?'.
std::string escape_xml(std::string_view text);

/// The approximate width of a text in a common sans-serif font.
double text_width(std::string_view text, const TextStyle& style);

class Svg {
public:
    Svg(double width, double height, std::string_view title);

    void rectangle(const Box& box, std::string_view fill, double opacity = 1);
    void line(Point from, Point to, const Stroke& stroke);
    /// Each inner vector is one unbroken line.
    void path(const std::vector<std::vector<Point>>& lines, const Stroke& stroke);
    /// Filled shapes.
    void area(const std::vector<std::vector<Point>>& shapes, std::string_view fill, double opacity);
    void dot(Point at, double radius, std::string_view colour);
    void text(Point at, std::string_view content, const TextStyle& style);

    /// The complete document.
    std::string finish() &&;

private:
    void stroke(const Stroke& stroke);
    void points(const std::vector<std::vector<Point>>& lines);
    void attribute(std::string_view name, double value);
    void attribute(std::string_view name, std::string_view value);

    std::string out_;
};

}  // namespace lockstep::drawing
