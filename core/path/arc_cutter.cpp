#include "core/path/arc_cutter.hpp"

#include <algorithm>
#include <cmath>

#include "core/path/travel_end.hpp"

namespace lockstep {
namespace {

constexpr double kTolerance_steps = 0.1;  // of the pieces, in addition to half a step of the pulses
constexpr double kPieceError = 0.008;     // times the radius and the cube of the angle
constexpr double kLeastRadius_steps = 0.25;
constexpr double kSameDirection = 1e-9;  // sine: ends that are closer make a whole circle
constexpr double kQuarter = 1.5707963267948966;

/// A unit vector in the plane of the arc. Clockwise arcs are mirrored, so that all arcs turn the same way.
struct Direction {
    double x = 0;
    double y = 0;
    Direction quarter_on() const { return {-y, x}; }
    double dot(Direction o) const { return x * o.x + y * o.y; }
    double cross(Direction o) const { return x * o.y - y * o.x; }
};

Direction unit(double x, double y) {
    const double length = std::sqrt(x * x + y * y);
    return {x / length, y / length};
}

Direction between(Direction a, Direction b) { return unit(a.x + b.x, a.y + b.y); }

/// The angle from a to b, less than a quarter turn. It is halved until the series of the arc sine is exact to 1e-16.
double angle_between(Direction a, Direction b) {
    double scale = 1;
    for (int halvings = 0; halvings < 8; ++halvings, scale *= 2) { b = between(a, b); }
    const double sine = a.cross(b);
    const double square = sine * sine;
    return scale * sine * (1 + square * (1.0 / 6 + square * (3.0 / 40)));
}

class ArcCut {
public:
    ArcCut(const PathSetup& setup, const ArcShape& arc, const ArcEnds& ends, std::uint32_t block, PathTrail& out)
        : setup_(setup), arc_(arc), from_(ends.from), to_(ends.to), at_(ends.at), block_(block), out_(out) {}

    bool cut(const Quadratic& pattern) {
        pattern_ = pattern;
        const Direction begin = direction(from_, radius_begin_);
        const Direction end = direction(to_, radius_end_);
        const double least_mm = kLeastRadius_steps / scale();
        if (!(radius_begin_ > least_mm) || !(radius_end_ > least_mm)) { return false; }
        const int quarters = quarters_between(begin, end);
        const double part = angle_between(turned(begin, quarters), end);
        const bool has_part = part > kSameDirection;
        const int all = quarters + 4 * (arc_.turns - 1);
        sweep_ = all * kQuarter + (has_part ? part : 0);
        off_ = at_;
        for (std::size_t i = 0; i < off_.size(); ++i) {
            off_[i] -= from_[i];
            is_off_ = is_off_ || off_[i] != 0;
        }
        for (int k = 0; k < all; ++k) {
            const Direction a = turned(begin, k);
            const bool is_last = k + 1 == all && !has_part;
            halve(a, a.quarter_on(), k * kQuarter, kQuarter, is_last);
        }
        if (has_part) { halve(turned(begin, quarters), end, all * kQuarter, part, true); }
        return true;
    }

private:
    /// Steps per mm of the finer axis of its plane.
    double scale() const { return std::max(setup_.steps_per_mm[arc_.first], setup_.steps_per_mm[arc_.second]); }

    Direction direction(const AxisVector& at, double& radius_mm) const {
        const double x = at[arc_.first] / setup_.steps_per_mm[arc_.first] - arc_.centre_first_mm;
        const double y = at[arc_.second] / setup_.steps_per_mm[arc_.second] - arc_.centre_second_mm;
        radius_mm = std::sqrt(x * x + y * y);
        return unit(x, arc_.is_clockwise ? -y : y);
    }

    static Direction turned(Direction a, int quarters) {
        for (int k = 0; k < quarters % 4; ++k) { a = a.quarter_on(); }
        return a;
    }

    /// Whole quarter turns from one direction to the other: 4 if they are the same, otherwise 0 to 3.
    static int quarters_between(Direction a, Direction b) {
        if (a.dot(b) > 0 && std::abs(a.cross(b)) <= kSameDirection) { return 4; }
        int quarters = 0;
        while (!(a.dot(b) > 0 && a.cross(b) >= -kSameDirection)) {
            a = a.quarter_on();
            ++quarters;
        }
        return quarters;
    }

    /// Adds the part from direction a to b, `angle` long and `done` behind the arc's begin. Halves it while too long.
    void halve(Direction a, Direction b, double done, double angle, bool is_last) {
        const double radius = std::max(radius_begin_, radius_end_);
        const Direction middle = between(a, b);
        if (kPieceError * radius * scale() * angle * angle * angle > tolerance(done / sweep_, angle / sweep_)) {
            halve(a, middle, done, angle / 2, false);
            halve(middle, b, done + angle / 2, angle / 2, is_last);
            return;
        }
        piece(place(middle, done + angle / 2), is_last ? to_ : place(b, done + angle));
    }

    /// The offset of the arc's begin decreases along the arc. Together with the piece's own error it is at most half a
    /// step.
    double tolerance(double before, double share) const {
        return is_off_ ? std::min(kTolerance_steps, before / 2 + share / 8) : kTolerance_steps;
    }

    AxisVector place(Direction d, double done) const {
        const double share = done / sweep_;
        AxisVector at = from_;
        for (std::size_t i = 0; i < at.size(); ++i) { at[i] += (to_[i] - from_[i]) * share; }
        const double radius = radius_begin_ + (radius_end_ - radius_begin_) * share;
        const double y = arc_.is_clockwise ? -d.y : d.y;
        at[arc_.first] = (arc_.centre_first_mm + radius * d.x) * setup_.steps_per_mm[arc_.first];
        at[arc_.second] = (arc_.centre_second_mm + radius * y) * setup_.steps_per_mm[arc_.second];
        for (std::size_t i = 0; i < at.size(); ++i) {
            if (is_off_) { at[i] += off_[i] * (1 - share); }
            const TravelEnds travel = travel_ends_of(setup_.limits[i]);
            at[i] = std::clamp(at[i], travel.least, travel.greatest);
        }
        return at;
    }

    /// The length is the chord's plus the excess of the arc: 8/3 of the square of its height, divided by the chord.
    void piece(const AxisVector& middle, const AxisVector& end) {
        Quadratic piece = pattern_;
        const double chord = distance_mm(at_, end, setup_.steps_per_mm);
        AxisVector half_way = at_;
        for (std::size_t i = 0; i < at_.size(); ++i) { half_way[i] = (at_[i] + end[i]) / 2; }
        const double height = distance_mm(half_way, middle, setup_.steps_per_mm);
        piece.length = chord + 8 * height * height / (3 * chord);
        piece.from = at_;
        piece.slope = piece.bend = at_;
        for (std::size_t i = 0; i < at_.size(); ++i) {
            piece.slope[i] = (end[i] - at_[i]) / piece.length;
            piece.bend[i] = -8 * (middle[i] - half_way[i]) / (piece.length * piece.length);
        }
        piece.is_straight = false;
        keep_within_travel(setup_, piece);
        at_ = end;
        out_.mark(0, block_, along_);
        out_.add(piece);
        along_ += piece.length;
    }

    const PathSetup& setup_;
    const ArcShape& arc_;
    AxisVector from_;
    AxisVector to_;
    AxisVector at_;  // where the next piece begins
    std::uint32_t block_;
    PathTrail& out_;
    Quadratic pattern_;
    double radius_begin_ = 0;  // mm
    double radius_end_ = 0;    // mm
    double sweep_ = 0;         // rad, of the whole arc
    AxisVector off_;           // the place of the axes at the begin minus the programmed begin
    bool is_off_ = false;
    double along_ = 0;  // mm of the arc before the next piece
};

}  // namespace

bool cut_arc(const PathSetup& setup, const ArcShape& arc, const ArcEnds& ends, const MoveSettings& settings,
             std::uint32_t block, PathTrail& out) {
    Quadratic pattern;
    pattern.feed_mm_per_tick = settings.feed_mm_per_tick;
    pattern.is_feed_fixed = settings.is_feed_fixed;
    return ArcCut(setup, arc, ends, block, out).cut(pattern);
}

}  // namespace lockstep
