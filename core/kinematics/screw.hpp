// The measured errors of a screw, and where its motor goes so that the slide is where it is asked to be:
//
//     motor = place - error(place).
//
// The error leads through the measured points as a smooth curve: it is a quadratic on each half of the way between two
// points, and no slope jumps, so neither does a motor's speed. At a point the slope is that of the parabola through it
// and its neighbours; before the first point and behind the last one the error is a line. So while the slide moves with
// constant acceleration, a path in quadratics needs a cut only at the knots: the points, and the middles between them.
#pragma once

#include <span>
#include <vector>

namespace lockstep {

/// A measured point, in any unit of length.
struct ScrewError {
    double place = 0;
    double error = 0;
};

class Screw {
public:
    /// An exact screw.
    Screw() = default;
    /// Exact, unless there are two points or more, with ascending places.
    explicit Screw(std::span<const ScrewError> points);

    bool is_exact() const { return knots_.empty(); }
    double error(double place) const;
    /// The place of the motor.
    double motor(double place) const { return is_exact() ? place : place - error(place); }
    /// By how much the motor moves for a small move of the slide.
    double slope(double place) const;
    /// The place of the slide. `motor` is the inverse of this function if the slope of the error is within 0.5.
    double place(double motor) const;

    /// Where the curve changes, in ascending order.
    std::span<const double> knots() const { return places_; }
    /// The greatest slope of the error, without its sign.
    double most_slope() const { return most_slope_; }
    /// The greatest change of its slope for each unit of the way, without its sign. 0: the error is a line.
    double most_bend() const { return most_bend_; }

private:
    /// From here on the error is error + slope x + bend x^2 / 2, with x the distance.
    struct Knot {
        double error = 0;
        double slope = 0;
        double bend = 0;
    };
    struct Spot {
        Knot from;
        double distance = 0;
    };
    Spot spot(double place) const;
    void add(double place, const Knot& knot);

    std::vector<double> places_;
    std::vector<Knot> knots_;
    double most_slope_ = 0;
    double most_bend_ = 0;
};

}  // namespace lockstep
