#include "clients/web/program/path_points.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

#include "core/arc_path.hpp"

namespace lockstep::web {
namespace {

constexpr double kChord_mm = 0.01;  // the greatest distance of a chord from its arc
constexpr double kFirstTolerance_mm = 0.001;
constexpr std::size_t kMostLeftOut = 64;  // between two kept points, in one pass
constexpr int kMostPasses = 60;
constexpr int kPassesByKind = 24;  // after these, rapid and other moves may be joined, too

using Place = std::array<double, 3>;

Place place_of(const PathPoint& point) { return {point.x, point.y, point.z}; }

double dot(const Place& a, const Place& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Place minus(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// Returns the squared distance of a point from the segment between two places.
double distance2(const Place& point, const Place& from, const Place& to) {
    const Place along = minus(to, from);
    const Place off = minus(point, from);
    const double length2 = dot(along, along);
    const double share = length2 > 0 ? std::clamp(dot(off, along) / length2, 0.0, 1.0) : 0;
    const Place rest = minus(off, {along[0] * share, along[1] * share, along[2] * share});
    return dot(rest, rest);
}

/// Whether the points between `first` and `last` may be left out.
bool may_join(const std::vector<PathPoint>& points, std::size_t first, std::size_t last, double tolerance,
              bool by_kind) {
    const Place from = place_of(points[first]);
    const Place to = place_of(points[last]);
    for (std::size_t i = first + 1; i < last; ++i) {
        if (by_kind && points[i].is_rapid != points[last].is_rapid) { return false; }
        if (distance2(place_of(points[i]), from, to) > tolerance * tolerance) { return false; }
    }
    return true;
}

std::vector<PathPoint> pass(const std::vector<PathPoint>& points, double tolerance, bool by_kind) {
    std::vector<PathPoint> kept{points.front()};
    std::size_t first = 0;
    while (first + 1 < points.size()) {
        std::size_t last = first + 1;
        // Doubles the step each time, so that a long straight line takes few checks.
        for (std::size_t step = 1; step <= kMostLeftOut && first + 1 + step < points.size(); step *= 2) {
            if (!may_join(points, first, first + 1 + step, tolerance, by_kind)) { break; }
            last = first + 1 + step;
        }
        kept.push_back(points[last]);
        first = last;
    }
    return kept;
}

}  // namespace

std::vector<PathPoint> path_points(const Program& program) {
    std::array<std::optional<std::size_t>, 3> axes;
    for (std::size_t i = 0; i < program.axes.size(); ++i) {
        const std::size_t place = program.axes[i].size() == 1 ? std::string_view("XYZ").find(program.axes[i]) : 3;
        if (place < axes.size()) { axes[place] = i; }
    }
    const auto point = [&](const std::vector<double>& mm, std::optional<std::int32_t> line, bool is_rapid) {
        const auto value = [&](std::size_t i) { return axes[i] ? static_cast<float>(mm[*axes[i]]) : 0.0F; };
        return PathPoint{value(0), value(1), value(2), static_cast<std::uint32_t>(line.value_or(0)), is_rapid};
    };
    std::vector<PathPoint> points{point(program.start_mm, {}, true)};
    points.reserve(program.blocks.size() + 1);
    std::vector<double> at = program.start_mm;
    for (const Block& block : program.blocks) {
        const auto* move = std::get_if<ProgramMove>(&block.action);
        if (move == nullptr) { continue; }
        each_chord(*move, at, kChord_mm, [&](const std::vector<double>& to) {
            const PathPoint next = point(to, block.line, move->rapid);
            if (place_of(next) != place_of(points.back())) { points.push_back(next); }
        });
        at = move->target_mm;
    }
    return points;
}

ReducedPath reduced_path(std::vector<PathPoint> points, std::size_t most) {
    ReducedPath reduced{.points = std::move(points)};
    double tolerance = kFirstTolerance_mm;
    for (int i = 0; i < kMostPasses && reduced.points.size() > std::max<std::size_t>(most, 2); ++i) {
        reduced.points = pass(reduced.points, tolerance, i < kPassesByKind);
        reduced.tolerance_mm += tolerance;
        tolerance *= 2;
    }
    return reduced;
}

std::string path_bytes(const std::vector<PathPoint>& points) {
    constexpr std::uint32_t kRapid = 1U << 31;
    std::string bytes;
    bytes.reserve(points.size() * 16);
    const auto add = [&](std::uint32_t word) {
        for (int shift = 0; shift < 32; shift += 8) { bytes += static_cast<char>((word >> shift) & 255); }
    };
    for (const PathPoint& point : points) {
        add(std::bit_cast<std::uint32_t>(point.x));
        add(std::bit_cast<std::uint32_t>(point.y));
        add(std::bit_cast<std::uint32_t>(point.z));
        add((point.line & ~kRapid) | (point.is_rapid ? kRapid : 0));
    }
    return bytes;
}

}  // namespace lockstep::web
