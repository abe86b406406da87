#include "core/kinematics/screw.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

constexpr int kMostRounds = 64;
constexpr double kExact = 0x1p-50;  // of the place and one unit more

bool is_ascending(std::span<const ScrewError> points) {
    for (std::size_t k = 1; k < points.size(); ++k) {
        if (!(points[k].place > points[k - 1].place)) { return false; }
    }
    return true;
}

/// The slope of the chord to the next point.
double chord(std::span<const ScrewError> points, std::size_t k) {
    return (points[k + 1].error - points[k].error) / (points[k + 1].place - points[k].place);
}

/// The slope at a point.
double tangent(std::span<const ScrewError> points, std::size_t k) {
    if (k == 0) { return chord(points, 0); }
    if (k + 1 == points.size()) { return chord(points, k - 1); }
    const double before = points[k].place - points[k - 1].place;
    const double behind = points[k + 1].place - points[k].place;
    return (chord(points, k - 1) * behind + chord(points, k) * before) / (before + behind);
}

}  // namespace

Screw::Screw(std::span<const ScrewError> points) {
    if (points.size() < 2 || !is_ascending(points)) { return; }
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const ScrewError& from = points[k];
        const double half = (points[k + 1].place - from.place) / 2;
        const double begin = tangent(points, k);
        const double end = tangent(points, k + 1);
        const double middle = 2 * chord(points, k) - (begin + end) / 2;
        add(from.place, {from.error, begin, (middle - begin) / half});
        add(from.place + half, {from.error + (begin + middle) / 2 * half, middle, (end - middle) / half});
    }
    add(points.back().place, {points.back().error, tangent(points, points.size() - 1), 0});
}

void Screw::add(double place, const Knot& knot) {
    places_.push_back(place);
    knots_.push_back(knot);
    most_slope_ = std::max(most_slope_, std::abs(knot.slope));
    most_bend_ = std::max(most_bend_, std::abs(knot.bend));
}

/// Before the first knot the error is a line with its slope.
Screw::Spot Screw::spot(double place) const {
    const auto next = std::ranges::upper_bound(places_, place);
    if (next == places_.begin()) {
        return {.from = {knots_.front().error, knots_.front().slope, 0}, .distance = place - places_.front()};
    }
    const auto k = static_cast<std::size_t>(next - places_.begin()) - 1;
    return {.from = knots_[k], .distance = place - places_[k]};
}

double Screw::error(double place) const {
    if (is_exact()) { return 0; }
    const auto [from, x] = spot(place);
    return from.error + (from.slope + from.bend * x / 2) * x;
}

double Screw::slope(double place) const {
    if (is_exact()) { return 1; }
    const auto [from, x] = spot(place);
    return 1 - (from.slope + from.bend * x);
}

/// By Newton's method. As slopes of the error are small, each round is nearer than a quarter of the one before.
double Screw::place(double motor) const {
    if (is_exact()) { return motor; }
    double at = motor;
    for (int round = 0; round < kMostRounds; ++round) {
        const double change = (motor - this->motor(at)) / slope(at);
        at += change;
        if (std::abs(change) <= kExact * (1 + std::abs(at))) { break; }
    }
    return at;
}

}  // namespace lockstep
