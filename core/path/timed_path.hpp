// The path in time: phases of constant du/dt^2, in ticks from the begin of a frame.
#pragma once

#include <vector>

#include "core/path/speed_window.hpp"

namespace lockstep {

/// How a straight interval is passed: the speed rises, is constant and falls.
struct StraightPassage {
    double top = 0;   // the greatest w
    double rise = 0;  // mm, with the interval's acceleration
    double fall = 0;  // mm, with its deceleration

    /// `w0` and `w1`: the squared speeds at the interval's ends.
    StraightPassage(const Interval& part, double w0, double w1);
};

/// The time, in ticks, in which the square of the speed changes linearly over `mm`, from v0 to v1, both in mm per tick.
/// 0 if mm is 0 or less. v0 and v1 are not both 0.
inline double ticks_over(double mm, double v0, double v1) { return mm > 0 ? 2 * mm / (v0 + v1) : 0; }

/// Constant acceleration along one piece of geometry.
struct PathPhase {
    const Quadratic* shape = nullptr;
    std::size_t interval = 0;  // the number of the interval
    std::size_t piece = 0;     // the number of the interval's piece in the window
    PathSpot origin;           // of this piece on the geometry
    double begin = 0;          // ticks
    double ticks = 0;
    double u = 0;         // mm, at its beginning
    double v = 0;         // mm per tick
    double a = 0;         // mm per tick^2
    bool breaks = false;  // begins with a jump of speed; no piece of constant acceleration may span it

    double end() const { return begin + ticks; }
    /// Place (mm) and speed (mm per tick) along the piece at a time, which is clamped to the phase.
    double along(double t) const;
    double speed(double t) const;
    /// The time at a place along the piece; in a rest, its begin.
    double time_at(double along) const;
    /// The spot on the geometry.
    PathSpot spot(double along_mm) const { return {origin.piece, origin.u + (shape->is_aside ? 0 : along_mm)}; }
    /// Place (steps) and velocity (steps per tick) of an axis.
    double place(std::size_t i, double t) const { return shape->place(i, along(t)); }
    double velocity(std::size_t i, double t) const { return shape->slope_at(i, along(t)) * speed(t); }
};

/// The passage of an interval.
struct Passage {
    std::size_t interval = 0;
    double begin = 0;  // ticks
    double w0 = 0;
    double w1 = 0;
    std::size_t first_phase = 0;
};

class TimedPath {
public:
    /// Clears the path and begins at a time.
    void begin(double ticks);
    /// Adds the passage of the interval `number` with the squared speeds w0 and w1 at its ends.
    void pass(const Quadratic& shape, const Interval& part, std::size_t number, double w0, double w1);
    /// Adds braking to rest within an interval; `w1` is its least_after(w0), below 0.
    void brake(const Quadratic& shape, const Interval& part, std::size_t number, double w0, double w1);
    /// Moves the origin of times to `ticks`.
    void shift(Ticks ticks);
    /// Adds a rest of the machine from the end of the last phase on.
    void rest();

    /// The time at the end of the last interval, or at which the path came to rest.
    double end() const { return end_; }
    /// The spot of this end on the geometry.
    PathSpot end_spot() const { return stop_.spot(stop_.u); }
    /// The spot at a time within the phases.
    PathSpot spot_at(double t) const;
    const std::vector<PathPhase>& phases() const { return phases_; }
    const std::vector<Passage>& passages() const { return passages_; }

private:
    void add(PathPhase phase, double mm, double u, double w0, double w1);
    void add_phase(const PathPhase& phase);

    static constexpr double kBreak = 0.05;  // of the start velocity: no piece spans a greater jump

    std::vector<PathPhase> phases_;
    std::vector<Passage> passages_;
    double end_ = 0;
    PathPhase stop_;       // at the end of the last interval
    bool breaks_ = false;  // at the beginning of the next phase
};

}  // namespace lockstep
