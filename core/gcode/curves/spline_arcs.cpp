#include "core/gcode/curves/spline_arcs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/gcode/curves/spline_curve.hpp"
#include "core/gcode/flat.hpp"

namespace lockstep::gcode {
namespace {

constexpr int kMostHalvings = 14;      // of half a span, at most
constexpr double kStraight_mm = 1e-6;  // a curve that is closer to its chord is straight: no arc has to be so flat

Flat xy_of(const Vector& at) { return {at[0], at[1]}; }
Flat unit(Flat a) { return dot(a, a) > 0 ? a * (1 / length_of(a)) : Flat{}; }

struct Spot {
    Flat at;
    Flat direction;  // of length 1, or 0 if there is none
};

/// An arc of less than half a turn, or a straight line, that begins at a spot in its direction and ends at a place.
class FlatArc {
public:
    static FlatArc line(Flat from, Flat to) { return {from, to, {}, 0}; }
    /// Returns nullopt if the arc would be half a turn or more.
    static std::optional<FlatArc> from_to(const Spot& from, Flat to) {
        const Flat chord = to - from.at;
        const double along = dot(from.direction, chord);
        const double aside = cross(from.direction, chord);  // above 0: to the left
        if (!(along > 0)) { return std::nullopt; }
        if (std::abs(aside) / 4 <= kStraight_mm / 8) { return line(from.at, to); }  // the arc's height
        const double radius = dot(chord, chord) / (2 * aside);
        return FlatArc{from.at, to, from.at + left_of(from.direction) * radius, radius};
    }

    double distance(Flat place) const {
        if (radius_ != 0) { return std::abs(length_of(place - centre_) - std::abs(radius_)); }
        const Flat chord = to_ - from_;
        const double square = dot(chord, chord);
        const double share = square > 0 ? std::clamp(dot(place - from_, chord) / square, 0.0, 1.0) : 0;
        return length_of(place - from_ - chord * share);
    }

    /// Makes a motion to `target`. X and Y of `target` are the arc's end.
    Action motion(const Point& target, double feed) const {
        if (radius_ == 0) { return Straight{.target = target, .feed = feed}; }
        return Arc{.target = target,
                   .centre = {centre_.x, centre_.y, target[2]},
                   .axis = {0, 0, 1},
                   .turns = radius_ > 0 ? 1 : -1,
                   .feed = feed};
    }
    Flat end() const { return to_; }

private:
    FlatArc(Flat from, Flat to, Flat centre, double radius) : from_(from), to_(to), centre_(centre), radius_(radius) {}

    Flat from_;
    Flat to_;
    Flat centre_;
    double radius_;  // 0: straight; below 0: clockwise
};

/// The spot at which the two arcs between two spots meet. The tangents at the ends, up to the tangent at this spot, are
/// equally long.
Spot meeting(const Spot& begin, const Spot& end) {
    const Flat chord = end.at - begin.at;
    const double along = dot(chord, begin.direction + end.direction);
    const double turn = 2 * (1 - dot(begin.direction, end.direction));
    const double square = dot(chord, chord);
    const double tangent = square / (along + std::sqrt(along * along + turn * square));
    const Flat first = begin.at + begin.direction * tangent;
    const Flat last = end.at - end.direction * tangent;
    return {(first + last) * 0.5, unit(last - first)};
}

class SplineCut {
public:
    SplineCut(const Spline& spline, const Point& from, double tolerance_mm,
              const std::function<void(const Action&)>& take)
        : spline_(spline),
          curve_(spline),
          near_mm_(std::max(tolerance_mm, kStraight_mm) / 2),
          take_(take),
          at_(spline.target),
          begin_{from[0], from[1]} {}

    void cut() {
        for (span_ = 0; span_ < curve_.spans(); ++span_) {
            const auto low = static_cast<double>(span_);
            const Spot middle = spot(low + 0.5);
            Spot end = spot(low + 1);
            if (span_ + 1 == curve_.spans()) { end.at = {spline_.target[0], spline_.target[1]}; }
            halve({spot(low), middle, low, low + 0.5}, kMostHalvings);
            halve({middle, end, low + 0.5, low + 1}, kMostHalvings);
        }
    }

private:
    struct Part {
        Spot begin;
        Spot end;
        double low;
        double high;
    };

    void halve(Part part, int halvings) {
        part.begin.at = begin_;
        const FlatArc line = FlatArc::line(begin_, part.end.at);
        if (halvings == 0) { return add(line); }
        const double middle = (part.low + part.high) / 2;
        const Spot half_way = spot(middle);
        if (is_near(part, half_way.at, line, line, kStraight_mm / 2)) { return add(line); }
        if (try_arcs(part, half_way.at)) { return; }
        halve({part.begin, half_way, part.low, middle}, halvings - 1);
        halve({half_way, part.end, middle, part.high}, halvings - 1);
    }

    Flat place(double parameter) const { return xy_of(curve_.in_span(span_, parameter).at); }
    Spot spot(double parameter) const {
        const SplineCurve::Spot spot = curve_.in_span(span_, parameter);
        return {xy_of(spot.at), unit(xy_of(spot.direction))};
    }

    bool try_arcs(const Part& part, Flat half_way) {
        if (part.begin.direction == Flat{} || part.end.direction == Flat{}) { return false; }
        const Spot middle = meeting(part.begin, part.end);
        const auto first = FlatArc::from_to(part.begin, middle.at);
        const auto second = FlatArc::from_to(middle, part.end.at);
        if (!first || !second || !is_near(part, half_way, *first, *second, near_mm_)) { return false; }
        add(*first);
        add(*second);
        return true;
    }

    /// Checks seven places between the ends. Arcs that are too long are mostly too far from the first one.
    bool is_near(const Part& part, Flat half_way, const FlatArc& first, const FlatArc& second, double most_mm) const {
        const auto is_near_to = [&](Flat place) {
            return first.distance(place) <= most_mm || second.distance(place) <= most_mm;
        };
        constexpr std::array kEighths{2.0, 6.0, 1.0, 3.0, 5.0, 7.0};
        return is_near_to(half_way) && std::ranges::all_of(kEighths, [&](double eighths) {
                   return is_near_to(place(part.low + (part.high - part.low) * eighths / 8));
               });
    }

    void add(const FlatArc& arc) {
        begin_ = arc.end();
        at_[0] = begin_.x;
        at_[1] = begin_.y;
        take_(arc.motion(at_, spline_.feed));
    }

    const Spline& spline_;
    SplineCurve curve_;
    double near_mm_;  // half of the tolerance, at the places that are checked
    const std::function<void(const Action&)>& take_;
    Point at_;
    Flat begin_;  // of the remaining part
    std::size_t span_ = 0;
};

}  // namespace

void cut_into_arcs(const Spline& spline, const Point& from, double tolerance_mm,
                   const std::function<void(const Action&)>& take) {
    SplineCut(spline, from, tolerance_mm, take).cut();
}

}  // namespace lockstep::gcode
