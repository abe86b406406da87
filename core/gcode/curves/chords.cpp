#include "core/gcode/curves/chords.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/gcode/curves/spline_curve.hpp"

namespace lockstep::gcode {
namespace {

Vector operator+(Vector a, Vector b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector operator-(Vector a, Vector b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector operator*(Vector a, double factor) { return {a[0] * factor, a[1] * factor, a[2] * factor}; }
double dot(Vector a, Vector b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(Vector a) { return std::sqrt(dot(a, a)); }
Vector cross(Vector a, Vector b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector xyz(const Point& point) { return {point[0], point[1], point[2]}; }

/// The place at a share of the way between two places, with X, Y and Z given.
Point between(const Point& from, const Point& to, double share, Vector at) {
    Point result;
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
        result[axis] = axis < 3 ? at[axis] : from[axis] + (to[axis] - from[axis]) * share;
    }
    return result;
}

struct Cylinder {
    Vector centre;  // at the start's height
    Vector axis;
    Vector along;   // from the axis to the start, of length 1
    Vector aside;   // `along` turned by a quarter turn
    double begins;  // radius
    double ends;
    double rise;
    double sweep;  // signed

    Vector at(double share) const {
        const double radius = begins + (ends - begins) * share;
        const double angle = sweep * share;
        return centre + along * (radius * std::cos(angle)) + aside * (radius * std::sin(angle)) + axis * (rise * share);
    }
};

Cylinder cylinder_of(const Arc& arc, const Point& from) {
    const Vector start = xyz(from) - arc.centre;
    const Vector end = xyz(arc.target) - arc.centre;
    Cylinder result{};
    result.axis = arc.axis;
    const double height = dot(start, arc.axis);
    result.rise = dot(end, arc.axis) - height;
    result.centre = arc.centre + arc.axis * height;
    const Vector flat = start - arc.axis * height;
    const Vector flat_end = end - arc.axis * dot(end, arc.axis);
    result.begins = length(flat);
    result.ends = length(flat_end);
    result.along = flat * (1 / result.begins);
    result.aside = cross(arc.axis, result.along);
    const int direction = arc.turns < 0 ? -1 : 1;
    double angle = direction * std::atan2(dot(flat_end, result.aside), dot(flat_end, result.along));
    constexpr double kNone = 1e-10;  // rad; with a smaller angle between its ends an arc is a whole turn
    if (angle <= kNone) { angle += 2 * std::numbers::pi; }
    result.sweep = direction * (angle + 2 * std::numbers::pi * (std::abs(arc.turns) - 1));
    return result;
}

/// A chord over the angle a deviates from its arc by r (1 - cos(a/2)). A radius that changes by c per rad adds 2 c to
/// r.
double chords_of(const Cylinder& cylinder, double tolerance) {
    const double change = std::abs((cylinder.ends - cylinder.begins) / cylinder.sweep);
    const double radius = std::max(cylinder.begins, cylinder.ends) + 2 * change;
    const double share = std::clamp(1 - tolerance / radius, 0.0, 1 - 1e-15);
    return std::max(std::ceil(std::abs(cylinder.sweep) / (2 * std::acos(share))), 1.0);
}

class CurveCutter {
public:
    CurveCutter(const SplineCurve& curve, double tolerance, const std::function<void(double, Vector)>& take)
        : curve_(curve), tolerance_(tolerance), take_(take) {}

    void cut(double from, Vector begin, double to, Vector end, int depth) {
        const double middle = (from + to) / 2;
        const Vector half = curve_.at(middle);
        if (depth == 0 || (is_near(curve_.at((from + middle) / 2), begin, end) && is_near(half, begin, end) &&
                           is_near(curve_.at((middle + to) / 2), begin, end))) {
            return take_(to, end);
        }
        cut(from, begin, middle, half, depth - 1);
        cut(middle, half, to, end, depth - 1);
    }

private:
    bool is_near(Vector place, Vector begin, Vector end) const {
        const Vector chord = end - begin;
        const double square = dot(chord, chord);
        const double share = square > 0 ? std::clamp(dot(place - begin, chord) / square, 0.0, 1.0) : 0;
        return length(place - begin - chord * share) <= tolerance_;
    }

    const SplineCurve& curve_;
    double tolerance_;
    const std::function<void(double, Vector)>& take_;
};

}  // namespace

double chords_in(const Arc& arc, const Point& from, double tolerance) {
    return chords_of(cylinder_of(arc, from), tolerance);
}

void cut(const Arc& arc, const Point& from, double tolerance, const TakeChord& take) {
    const Cylinder cylinder = cylinder_of(arc, from);
    const double chords = chords_of(cylinder, tolerance);
    for (std::int64_t i = 1; static_cast<double>(i) < chords; ++i) {
        const double share = static_cast<double>(i) / chords;
        take(between(from, arc.target, share, cylinder.at(share)));
    }
    take(arc.target);
}

void cut(const Spline& spline, const Point& from, double tolerance, const TakeChord& take) {
    constexpr int kPieces = 4;  // of each span, before halving
    constexpr int kHalvings = 12;
    const SplineCurve curve(spline);
    const double all = static_cast<double>(curve.spans());
    const std::function<void(double, Vector)> chord = [&](double parameter, Vector at) {
        if (parameter < all) { take(between(from, spline.target, parameter / all, at)); }
    };
    CurveCutter cutter(curve, tolerance, chord);
    Vector begin = xyz(from);
    const std::size_t pieces = curve.spans() * kPieces;
    for (std::size_t i = 0; i < pieces; ++i) {
        const double to = static_cast<double>(i + 1) / kPieces;
        const Vector end = curve.at(to);
        cutter.cut(static_cast<double>(i) / kPieces, begin, to, end, kHalvings);
        begin = end;
    }
    take(spline.target);
}

}  // namespace lockstep::gcode
