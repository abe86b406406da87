// The picture of a power map.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "clients/analysis/power/power_map.hpp"
#include "clients/drawing/palette.hpp"
#include "clients/drawing/svg.hpp"

namespace lockstep::analysis {
namespace {

using drawing::Box;
using drawing::Point;
using drawing::Svg;
using drawing::TextStyle;
using Quantity = PowerShades::Quantity;
namespace palette = drawing::palette;

constexpr int kLevels = 16;
constexpr double kWidth = 960;
constexpr double kMargin = 20;
constexpr double kMostWidth = (kWidth - 3 * kMargin) / 2;
constexpr double kMostHeight = 330;
constexpr double kTitleRoom = 24;
constexpr TextStyle kText{.size = 12, .colour = palette::kSoftInk};
constexpr TextStyle kHead{.size = 13, .bold = true};
const drawing::Stroke kHatch{.colour = std::string(palette::kAlarm), .width = 1};

std::vector<Point> corners(const Box& box) {
    return {{box.x, box.y}, {box.right(), box.y}, {box.right(), box.bottom()}, {box.x, box.bottom()}};
}

/// An unknown part has a slanting line too, so that it is not known by its colour alone.
void draw_unknown(Svg& svg, const std::vector<std::vector<Point>>& shapes) {
    svg.area(shapes, palette::kAlarm, 0.25);
    for (const auto& shape : shapes) { svg.line(shape[3], shape[1], kHatch); }
}

void draw_level(Svg& svg, const std::vector<std::vector<Point>>& shapes, int level) {
    if (shapes.empty()) { return; }
    if (level == PowerShades::kNotKnown) { return draw_unknown(svg, shapes); }
    if (level == PowerShades::kNoPower) { return svg.area(shapes, palette::kGrid, 1); }
    svg.area(shapes, palette::kInk, static_cast<double>(level) / kLevels);
}

/// Each run of equal cells of a row is one shape.
std::vector<std::vector<Point>> runs_of(const PowerShades& picture, int level, Point at, double scale) {
    std::vector<std::vector<Point>> shapes;
    for (std::size_t row = 0; row < picture.height; ++row) {
        const auto begin = picture.numbers.begin() + static_cast<std::ptrdiff_t>(row * picture.width);
        const auto end = begin + static_cast<std::ptrdiff_t>(picture.width);
        for (auto from = std::find(begin, end, level); from != end;) {
            const auto to = std::find_if(from, end, [&](int number) { return number != level; });
            shapes.push_back(
                corners({at.x + static_cast<double>(from - begin) * scale, at.y + static_cast<double>(row) * scale,
                         static_cast<double>(to - from) * scale, scale}));
            from = std::find(to, end, level);
        }
    }
    return shapes;
}

void draw(Svg& svg, const PowerShades& picture, Point at, double scale) {
    for (int level = PowerShades::kNotKnown; level <= kLevels; ++level) {
        if (level != PowerShades::kNoPath) { draw_level(svg, runs_of(picture, level, at, scale), level); }
    }
}

void draw_legend(Svg& svg, const PowerMap& map, double y) {
    double x = kMargin;
    const auto entry = [&](int level, const std::string& label) {
        draw_level(svg, {corners({x, y, 22, 14})}, level);
        svg.text({x + 28, y + 12}, label, kText);
        x += 28 + text_width(label, kText) + 16;
    };
    for (const int quarter : {1, 2, 3, 4}) { entry(kLevels * quarter / 4, fmt::format("{} %", 25 * quarter)); }
    entry(PowerShades::kNoPower, "path without power");
    if (map.unknown_mm > 0) { entry(PowerShades::kNotKnown, "? not known: changes missing from the log"); }
}

}  // namespace

std::string power_svg(const PowerMap& map, const std::string& title) {
    const CellBounds& bounds = map.asked.bounds();
    const double across = static_cast<double>(std::max<std::int64_t>(1, bounds.width));
    const double up = static_cast<double>(std::max<std::int64_t>(1, bounds.height));
    const double scale = std::min(kMostWidth / across, kMostHeight / up);
    const double row = up * scale + kTitleRoom + 14;
    const double top = 72;
    Svg svg(kWidth, top + 2 * row + 60, title);
    svg.text({kMargin, kMargin + 14}, title, {.size = 17, .bold = true});
    svg.text({kMargin, kMargin + 35}, map.summary(), kText);
    double y = top;
    for (const auto& [quantity, what] :
         {std::pair{Quantity::Power, std::string("power, % of full scale")},
          std::pair{Quantity::Energy,
                    fmt::format("energy for each mm, 100 %: {:.3g} ms of full power", 1e3 * map.most_energy)}}) {
        double x = kMargin;
        for (const auto& [grid, whose] : {std::pair{&map.asked, "asked for: "}, std::pair{&map.made, "made: "}}) {
            svg.text({x, y + 14}, whose + what, kHead);
            draw(svg, shades(map, *grid, quantity, kLevels), {x, y + kTitleRoom}, scale);
            x += kMostWidth + kMargin;
        }
        y += row;
    }
    draw_legend(svg, map, y + 4);
    const double cell = map.asked.cell_mm();
    svg.text(
        {kMargin, y + 42},
        fmt::format("X {:.4g} to {:.4g} mm, Y {:.4g} to {:.4g} mm, in cells of {:.4g} mm",
                    static_cast<double>(bounds.left) * cell, static_cast<double>(bounds.left + bounds.width) * cell,
                    static_cast<double>(bounds.bottom) * cell,
                    static_cast<double>(bounds.bottom + bounds.height) * cell, cell),
        kText);
    return std::move(svg).finish();
}

}  // namespace lockstep::analysis
