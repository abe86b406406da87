#include "core/path/geometry/arc_cutter.hpp"

#include <algorithm>
#include <cmath>

#include "core/path/geometry/travel_end.hpp"

namespace lockstep {
namespace {

constexpr double kTolerance_steps = 0.1;  // the greatest distance of a piece from its arc; pulses add half a step
constexpr double kPieceError = 0.008;     // the distance is this times angle^3 times (radius + 3 rad of its change)
constexpr double kLeastRadius_steps = 0.25;
constexpr double kSameDirection = 1e-9;  // the sine of an angle: ends of an arc that are closer make a whole circle
constexpr double kQuarter = 1.5707963267948966;
constexpr double kSameRadius_steps = 1e-3;  // turns repeat if the radii of the ends differ by less

}  // namespace

/// A part of the arc from direction a to b, `angle` long and `done` behind the arc's begin.
struct ArcCutter::Part {
    Direction a;
    Direction b;
    double done = 0;
    double angle = 0;
    bool is_last = false;
};

ArcCutter::Direction ArcCutter::unit(double x, double y) {
    const double length = std::sqrt(x * x + y * y);
    return {x / length, y / length};
}

/// The angle from a to b, less than a quarter turn. It is halved until the series of the arc sine is exact to 1e-16.
double ArcCutter::angle_between(Direction a, Direction b) {
    double scale = 1;
    for (int halvings = 0; halvings < 8; ++halvings, scale *= 2) { b = between(a, b); }
    const double sine = a.cross(b);
    const double square = sine * sine;
    return scale * sine * (1 + square * (1.0 / 6 + square * (3.0 / 40)));
}

bool ArcCutter::begin(const PathSetup& setup, const ArcShape& arc, const ArcEnds& ends, const MoveSettings& settings,
                      std::uint32_t block) {
    *this = ArcCutter();
    arc_ = arc;
    from_ = ends.from;
    to_ = ends.to;
    at_ = ends.at;
    block_ = block;
    pattern_.feed_mm_per_tick = settings.feed_mm_per_tick;
    pattern_.is_feed_fixed = settings.is_feed_fixed;
    pattern_.most_mm_per_tick = settings.most_mm_per_tick;
    begin_ = direction(setup, from_, radius_begin_);
    end_ = direction(setup, to_, radius_end_);
    const double least_mm = kLeastRadius_steps / scale(setup);
    if (!(std::min(radius_begin_, radius_end_) > 0) || std::max(radius_begin_, radius_end_) <= least_mm) {
        return false;
    }
    quarters_ = quarters_between(begin_, end_);
    part_ = angle_between(turned(begin_, quarters_), end_);
    has_part_ = part_ > kSameDirection;
    ends_whole_ = !has_part_;
    all_ = quarters_ + 4 * (arc_.turns - 1);
    sweep_ = all_ * kQuarter + (has_part_ ? part_ : 0);
    bent_ = std::max(radius_begin_, radius_end_) + 3 * std::abs(radius_end_ - radius_begin_) / sweep_;
    find_moving();
    return true;
}

/// Sets which axes move along the arc. The others stay where they are.
void ArcCutter::find_moving() {
    off_ = at_;
    moving_ = axis_bit(arc_.first) | axis_bit(arc_.second);
    for (std::size_t i = 0; i < off_.size(); ++i) {
        off_[i] -= from_[i];
        is_off_ = is_off_ || off_[i] != 0;
        if (off_[i] != 0 || to_[i] != from_[i]) { moving_ |= axis_bit(i); }
    }
    pattern_.slope = pattern_.bend = zeros(at_.size());
}

void ArcCutter::cut_on(const PathSetup& setup, PathTrail& out) {
    if (next_ < all_) {
        const int k = next_++;
        const Direction a = turned(begin_, k);
        return halve(setup, {a, a.quarter_on(), k * kQuarter, kQuarter, next_ == all_ && ends_whole_}, out);
    }
    if (!has_part_) { return; }
    has_part_ = false;
    halve(setup, {turned(begin_, quarters_), end_, all_ * kQuarter, part_, true}, out);
}

bool ArcCutter::repeats(const PathSetup& setup) const {
    return !is_off_ && std::abs(radius_end_ - radius_begin_) * scale(setup) < kSameRadius_steps;
}

void ArcCutter::skip(const PathSetup& setup, int turns) {
    next_ += 4 * turns;
    at_ = place(setup, turned(begin_, next_), next_ * kQuarter);
}

/// The most steps of a motor per mm of its plane.
double ArcCutter::scale(const PathSetup& setup) const {
    const auto of_axis = [&](std::size_t axis) { return setup.steps_per_mm[axis] / setup.step_of_motors(axis); };
    return std::max(of_axis(arc_.first), of_axis(arc_.second));
}

ArcCutter::Direction ArcCutter::direction(const PathSetup& setup, const AxisVector& at, double& radius_mm) const {
    const double x = at[arc_.first] / setup.steps_per_mm[arc_.first] - arc_.centre_first_mm;
    const double y = at[arc_.second] / setup.steps_per_mm[arc_.second] - arc_.centre_second_mm;
    radius_mm = std::sqrt(x * x + y * y);
    return unit(x, arc_.is_clockwise ? -y : y);
}

ArcCutter::Direction ArcCutter::turned(Direction a, int quarters) {
    for (int k = 0; k < quarters % 4; ++k) { a = a.quarter_on(); }
    return a;
}

/// Whole quarter turns from one direction to the other: 4 if they are the same, otherwise 0 to 3.
int ArcCutter::quarters_between(Direction a, Direction b) {
    if (a.dot(b) > 0 && std::abs(a.cross(b)) <= kSameDirection) { return 4; }
    int quarters = 0;
    while (!(a.dot(b) > 0 && a.cross(b) >= -kSameDirection)) {
        a = a.quarter_on();
        ++quarters;
    }
    return quarters;
}

/// Halves the part while it is too long for one piece.
void ArcCutter::halve(const PathSetup& setup, const Part& part, PathTrail& out) {
    const double angle = part.angle;
    const double half = part.done + angle / 2;
    const Direction middle = between(part.a, part.b);
    const double error = kPieceError * bent_ * scale(setup) * angle * angle * angle;
    if (error > tolerance(part.done / sweep_, angle / sweep_)) {
        halve(setup, {part.a, middle, part.done, angle / 2, false}, out);
        halve(setup, {middle, part.b, half, angle / 2, part.is_last}, out);
        return;
    }
    add_piece(setup, place(setup, middle, half), part.is_last ? to_ : place(setup, part.b, part.done + angle), out);
}

/// The offset of the arc's begin decreases along the arc. Together with the piece's own error it is at most half a
/// step.
double ArcCutter::tolerance(double before, double share) const {
    return is_off_ ? std::min(kTolerance_steps, before / 2 + share / 8) : kTolerance_steps;
}

AxisVector ArcCutter::place(const PathSetup& setup, Direction d, double done) const {
    const double share = done / sweep_;
    const double radius = radius_begin_ + (radius_end_ - radius_begin_) * share;
    const double y = arc_.is_clockwise ? -d.y : d.y;
    AxisVector at = at_;
    each_of(moving_, [&](std::size_t i) { at[i] = from_[i] + (to_[i] - from_[i]) * share; });
    at[arc_.first] = (arc_.centre_first_mm + radius * d.x) * setup.steps_per_mm[arc_.first];
    at[arc_.second] = (arc_.centre_second_mm + radius * y) * setup.steps_per_mm[arc_.second];
    each_of(moving_, [&](std::size_t i) {
        if (is_off_) { at[i] += off_[i] * (1 - share); }
        const TravelEnds travel = travel_ends_of(setup.limits_of_axis(i));
        at[i] = std::clamp(at[i], travel.least, travel.greatest);
    });
    return at;
}

/// The distance of two places on the arc.
double ArcCutter::distance(const PathSetup& setup, const AxisVector& a, const AxisVector& b) const {
    double square = 0;
    each_of(moving_, [&](std::size_t i) {
        const double mm = (b[i] - a[i]) / setup.steps_per_mm[i];
        square += mm * mm;
    });
    return std::sqrt(square);
}

/// The length is the chord's plus the excess of the arc: 8/3 of the square of its height, divided by the chord.
void ArcCutter::add_piece(const PathSetup& setup, const AxisVector& middle, const AxisVector& end, PathTrail& out) {
    Quadratic piece = pattern_;
    const double chord = distance(setup, at_, end);
    AxisVector half_way = at_;
    each_of(moving_, [&](std::size_t i) { half_way[i] = (at_[i] + end[i]) / 2; });
    const double height = distance(setup, half_way, middle);
    piece.length = chord + 8 * height * height / (3 * chord);
    piece.from = at_;
    each_of(moving_, [&](std::size_t i) {
        piece.slope[i] = (end[i] - at_[i]) / piece.length;
        piece.bend[i] = -8 * (middle[i] - half_way[i]) / (piece.length * piece.length);
    });
    piece.is_straight = false;
    keep_within_travel(setup, piece);
    at_ = end;
    out.mark(0, block_, along_);
    out.add(piece);
    along_ += piece.length;
}

bool cut_arc(const PathSetup& setup, const ArcShape& arc, const ArcEnds& ends, const MoveSettings& settings,
             std::uint32_t block, PathTrail& out) {
    ArcCutter cutter;
    if (!cutter.begin(setup, arc, ends, settings, block)) { return false; }
    while (!cutter.is_done()) { cutter.cut_on(setup, out); }
    return true;
}

}  // namespace lockstep
