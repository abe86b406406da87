#include "core/gcode/run/corner.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

namespace lockstep::gcode {
namespace {

constexpr double kTouch = 1e-9;  // mm: circles with a smaller gap count as touching

/// The curvature of the programmed path, 1/mm: above 0 to the left.
double curvature(const Track& track, Flat corner) {
    if (!track.centre) { return 0; }
    const double side = cross(track.direction, *track.centre - track.at) > 0 ? 1 : -1;
    return side / length_of(*track.centre - corner);
}

/// The places where a circle meets the line through `foot` along `way`. `foot` is nearest to its centre, at `distance`.
std::vector<Flat> both_sides(Flat foot, Flat way, double radius, double distance) {
    const double square = radius * radius - distance * distance;
    if (square < -kTouch * radius) { return {}; }
    const Flat aside = way * std::sqrt(std::max(square, 0.0));
    return {foot + aside, foot - aside};
}

std::vector<Flat> meet_lines(const Track& a, const Track& b) {
    const double sine = cross(a.direction, b.direction);
    if (std::abs(sine) < kTouch) { return {}; }
    return {a.at + a.direction * (cross(b.at - a.at, b.direction) / sine)};
}

std::vector<Flat> meet_circle(const Track& line, const Track& circle) {
    const double along = dot(*circle.centre - line.at, line.direction);
    const Flat foot = line.at + line.direction * along;
    return both_sides(foot, line.direction, circle.radius, length_of(foot - *circle.centre));
}

std::vector<Flat> meet_circles(const Track& a, const Track& b) {
    const Flat between = *b.centre - *a.centre;
    const double distance = length_of(between);
    if (distance < kTouch) { return {}; }
    const double along = (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2 * distance);
    const Flat way = between * (1 / distance);
    return both_sides(*a.centre + way * along, left_of(way), a.radius, std::abs(along));
}

std::vector<Flat> meet(const Track& a, const Track& b) {
    if (!a.centre && !b.centre) { return meet_lines(a, b); }
    if (!a.centre) { return meet_circle(a, b); }
    return b.centre ? meet_circles(a, b) : meet_circle(b, a);
}

}  // namespace

CornerKind corner_between(const Track& before, const Track& after, Flat corner, double radius) {
    const double deflection =
        std::atan2(cross(before.direction, after.direction), dot(before.direction, after.direction));
    if (std::abs(deflection) < kLeastCorner) { return CornerKind::Straight; }
    const bool reverses = std::abs(deflection) > std::numbers::pi - kLeastCorner;
    const bool is_inside =
        reverses ? radius * (curvature(before, corner) + curvature(after, corner)) < 0 : radius * deflection > 0;
    return is_inside ? CornerKind::Inside : CornerKind::Outside;
}

std::optional<Flat> meeting(const Track& before, const Track& after, Flat corner) {
    const std::vector<Flat> places = meet(before, after);
    if (places.empty()) { return std::nullopt; }
    return *std::ranges::min_element(places, {}, [&](Flat place) {
        const bool is_beyond = dot(place - before.at, before.direction) > kTouch;
        return std::tuple(is_beyond, length_of(place - corner));
    });
}

}  // namespace lockstep::gcode
