#include "core/path/geometry/motor_rows.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

constexpr std::size_t kMostParts = 1024;
constexpr double kLeastPart_mm = 1e-3;   // of a part that ends at a knot
constexpr double kMeasuredShare = 0.75;  // of kMapShare: between the places that are compared the distance is greater

/// The rows of the axes are behind the motors'.
template <typename Unit>
void append_axes(UnitVector<Unit>& rows, const UnitVector<Unit>& axes) {
    for (const double value : axes) { rows.append(value); }
}

/// A motor over a piece: its places at both ends, its slope and its bend as in Quadratic.
struct MotorWay {
    double from = 0;
    double to = 0;
    double slope = 0;
    double bend = 0;
};

/// Adds a motor to a piece of rows that has all but its motors and axes.
void append_motor(Quadratic& rows, const MotorWay& way) {
    const bool is_rest = rows.length == 0;
    const bool begins = rows.begins_at_rest || is_rest;
    const double from = begins ? std::round(way.from) : way.from;
    const double to = rows.ends_at_rest ? std::round(way.to) : way.to;
    const bool is_exact = is_rest || !(begins || rows.ends_at_rest);
    rows.from.append(from);
    rows.slope.append(is_exact ? way.slope : (to - from) / rows.length);
    rows.bend.append(way.bend);
}

/// The rows of a piece of the axes; `way_of(m)` is a motor's way over it.
template <typename WayOf>
Quadratic rows_of(const Quadratic& axes, std::size_t motors, WayOf way_of) {
    Quadratic rows = axes;
    rows.from.clear();
    rows.slope.clear();
    rows.bend.clear();
    for (const MotorIndex m : motor_indices(motors)) { append_motor(rows, way_of(m)); }
    append_axes(rows.from, axes.from);
    append_axes(rows.slope, axes.slope);
    append_axes(rows.bend, axes.bend);
    return rows;
}

/// The place of the axes.
PlaceVector way_at(const Quadratic& axes, double u) {
    PlaceVector place;
    for (std::size_t i = 0; i < axes.from.size(); ++i) { place.append(axes.place(i, u)); }
    return place;
}

/// The same, on whole steps if the machine rests there.
PlaceVector place_at(const Quadratic& axes, double u) {
    PlaceVector place = way_at(axes, u);
    const bool is_rest = axes.ends_at_rest && u == axes.length;
    for (double& steps : place) { steps = is_rest ? std::round(steps) : steps; }
    return place;
}

SlopeVector slope_at(const Quadratic& axes, double u) {
    SlopeVector slope;
    for (std::size_t i = 0; i < axes.slope.size(); ++i) { slope.append(axes.slope_at(i, u)); }
    return slope;
}

}  // namespace

Quadratic part_of(const Quadratic& axes, double from, double to) {
    Quadratic part = axes;
    part.from = place_at(axes, from);
    part.slope = slope_at(axes, (from + to) / 2);
    part.length = to - from;
    part.begin = axes.begin + from;
    part.begins_at_rest = axes.begins_at_rest && from == 0;
    part.ends_at_rest = axes.ends_at_rest && to == axes.length;
    return part;
}

namespace {

/// The way of a motor whose slopes do not change over the piece.
MotorWay straight_way(const MotorMap& map, MotorIndex m, const Quadratic& axes) {
    return {.from = map.place(m, axes.from),
            .to = map.place(m, place_at(axes, axes.length)),
            .slope = map.slope(m, axes.from, axes.slope),
            .bend = map.slope(m, axes.from, axes.bend)};
}

/// How far a motor is beside its place along a piece, in steps: where the machine rests, as far as its whole step is.
/// Between the ends it changes evenly, so that it bends no part of the piece.
class RestOffset {
public:
    RestOffset(const MotorMap& map, MotorIndex motor, const Quadratic& axes) {
        const auto to_whole = [&](double u) {
            return std::round(map.place(motor, place_at(axes, u))) - map.place(motor, way_at(axes, u));
        };
        begin_ = axes.begins_at_rest ? to_whole(0) : 0;
        slope_ = ((axes.ends_at_rest ? to_whole(axes.length) : 0) - begin_) / axes.length;
    }
    double at(double u) const { return begin_ + slope_ * u; }
    /// Steps per mm.
    double slope() const { return slope_; }

private:
    double begin_ = 0;
    double slope_ = 0;
};

/// Two quadratics with the places and the slopes of a motor's way at both ends of a part.
struct MotorCurve {
    MotorCurve(const MotorMap& map, MotorIndex motor, const Quadratic& axes, double a, double b)
        : half((b - a) / 2), offset(map, motor, axes) {
        from = map.place(motor, way_at(axes, a)) + offset.at(a);
        to = map.place(motor, way_at(axes, b)) + offset.at(b);
        begin_slope = map.slope(motor, way_at(axes, a), slope_at(axes, a)) + offset.slope();
        end_slope = map.slope(motor, way_at(axes, b), slope_at(axes, b)) + offset.slope();
        middle_slope = (to - from) / half - (begin_slope + end_slope) / 2;
        middle = from + (begin_slope + middle_slope) / 2 * half;
    }
    MotorWay first() const {
        return {from, middle, (begin_slope + middle_slope) / 2, (middle_slope - begin_slope) / half};
    }
    MotorWay second() const { return {middle, to, (middle_slope + end_slope) / 2, (end_slope - middle_slope) / half}; }
    /// In the middle of a half.
    double quarter(const MotorWay& way) const { return way.from + (way.slope - way.bend * half / 4) * half / 2; }

    double half = 0;  // mm
    RestOffset offset;
    double from = 0;  // steps
    double middle = 0;
    double to = 0;
    double begin_slope = 0;  // steps per mm
    double middle_slope = 0;
    double end_slope = 0;
};

}  // namespace

RowPieces::RowPieces(const PathSetup& setup, const Quadratic& axes) : setup_(setup), axes_(axes) {
    const bool is_curve = axes.length > 0 && (setup.motor_map.bends(axes.slope) || setup.motor_map.bends(axes.bend));
    if (!is_curve) { return; }
    cuts_.push_back(0);
    for (const double to : knots()) { add_parts(cuts_.back(), to); }
    end_ = 2 * (cuts_.size() - 1);
}

/// The places between which the screws are smooth, the last one at the end of the piece. Where several motors pass
/// knots together, only the first one counts.
std::vector<double> RowPieces::knots() const {
    std::vector<double> at;
    for (const MotorIndex m : motor_indices(setup_.motor_map.motors())) { add_knots(m, at); }
    std::ranges::sort(at);
    std::vector<double> knots;
    for (const double u : at) {
        const double before = knots.empty() ? 0 : knots.back();
        if (u - before > kLeastPart_mm && axes_.length - u > kLeastPart_mm) { knots.push_back(u); }
    }
    knots.push_back(axes_.length);
    return knots;
}

/// The motor's way without its screw is from + slope u + bend u (u - length) / 2, as in Quadratic.
void RowPieces::add_knots(MotorIndex motor, std::vector<double>& at) const {
    const Screw* const screw = setup_.motor_map.screw(motor);
    if (screw == nullptr) { return; }
    const LinearMap& shares = setup_.motor_map.shares();
    const double from = shares.place(motor, axes_.from);
    const double slope = shares.place(motor, axes_.slope);
    const double bend = shares.place(motor, axes_.bend);
    const double to = from + slope * axes_.length;
    const double aside = std::abs(bend) * axes_.length * axes_.length / 8;
    const auto begin = std::ranges::lower_bound(screw->knots(), std::min(from, to) - aside);
    const auto end = std::ranges::upper_bound(screw->knots(), std::max(from, to) + aside);
    const double begin_slope = slope - bend * axes_.length / 2;
    for (auto knot = begin; knot != end; ++knot) {
        const double root = begin_slope * begin_slope + 2 * bend * (*knot - from);
        if (root < 0) { continue; }
        const double sum = begin_slope + std::copysign(std::sqrt(root), begin_slope);
        if (sum != 0) { at.push_back(2 * (*knot - from) / sum); }
        if (bend != 0) { at.push_back(-sum / bend); }
    }
}

/// Cuts the way between two cuts into equal parts.
void RowPieces::add_parts(double from, double to) {
    std::size_t parts = 1;
    const auto cut = [&](std::size_t part) {
        return part == parts ? to : from + (to - from) * static_cast<double>(part) / static_cast<double>(parts);
    };
    const auto are_close = [&] {
        for (std::size_t k = 0; k < parts; ++k) {
            if (!is_close(cut(k), cut(k + 1))) { return false; }
        }
        return true;
    };
    while (parts < kMostParts && !are_close()) { parts *= 2; }
    for (std::size_t k = 1; k <= parts; ++k) { cuts_.push_back(cut(k)); }
}

/// Compares the quadratics of a part with the curve in their middles and where they meet.
bool RowPieces::is_close(double from, double to) const {
    const MotorMap& map = setup_.motor_map;
    const auto is_near = [&](MotorIndex m, const MotorCurve& curve, double u, double steps) {
        const double place = map.place(m, way_at(axes_, u)) + curve.offset.at(u);
        return std::abs(place - steps) <= kMeasuredShare * kMapShare;
    };
    for (const MotorIndex m : motor_indices(map.motors())) {
        if (!map.is_curved(m)) { continue; }
        const MotorCurve curve(map, m, axes_, from, to);
        const double quarter = (to - from) / 4;
        const bool is_close = is_near(m, curve, from + 2 * quarter, curve.middle) &&
                              is_near(m, curve, from + quarter, curve.quarter(curve.first())) &&
                              is_near(m, curve, to - quarter, curve.quarter(curve.second()));
        if (!is_close) { return false; }
    }
    return true;
}

Quadratic RowPieces::next() {
    const std::size_t number = next_++;
    if (!cuts_.empty()) { return half(number); }
    const MotorMap& map = setup_.motor_map;
    return rows_of(axes_, map.motors(), [&](MotorIndex m) { return straight_way(map, m, axes_); });
}

Quadratic RowPieces::half(std::size_t number) const {
    const MotorMap& map = setup_.motor_map;
    const double a = cuts_[number / 2];
    const double b = cuts_[number / 2 + 1];
    const bool is_first = number % 2 == 0;
    const double middle = (a + b) / 2;
    const Quadratic axes = is_first ? part_of(axes_, a, middle) : part_of(axes_, middle, b);
    Quadratic rows = rows_of(axes, map.motors(), [&](MotorIndex m) {
        const MotorCurve curve(map, m, axes_, a, b);
        return is_first ? curve.first() : curve.second();
    });
    rows.is_straight = false;
    return rows;
}

MotorPositions motors_at_rest(const PathSetup& setup, std::span<const Position> at) {
    MotorPositions motors;
    PlaceVector axes;
    for (const Position& position : at) { axes.append(position.as_steps()); }
    for (const MotorIndex m : motor_indices(setup.motors())) {
        motors.append(setup.has_map() ? Position::steps(std::llround(setup.motor_map.place(m, axes))) : at[m]);
    }
    for (std::size_t board = 0; board < setup.boards; ++board) { motors.append(Position{}); }
    return motors;
}

bool are_motors_on_steps(const PathSetup& setup, const PlaceVector& at) {
    if (!setup.has_map()) { return true; }
    for (const MotorIndex m : motor_indices(setup.motors())) {
        const double steps = setup.motor_map.place(m, at);
        if (steps != std::round(steps)) { return false; }
    }
    return true;
}

}  // namespace lockstep
