// The continuous ideal of a move: the trapezoid or triangle of its limits, and the times of its steps.
//
// From `start` the speed rises by `acceleration` to the peak, stays, and falls by `deceleration` to `start`:
//   peak = min(max, sqrt((2 a d N + (a + d) v0^2) / (a + d))).
// The position of step k is k or k - 1/2, by the convention of each method (Crossing).
#pragma once

#include <vector>

#include "core/motion/step_move.hpp"

namespace lockstep {

class Ideal {
public:
    /// The move must be possible: steps, speeds and accelerations above 0, the start not above the maximum.
    explicit Ideal(const StepMove& move);

    double duration_s() const { return rise_s_ + cruise_s_ + fall_s_; }
    double peak() const { return peak_; }  // steps/s
    /// The time in s at which a position, 0 ... steps, is reached.
    double time_s(double position) const;
    std::vector<double> step_times_s(Crossing crossing) const;

    /// The corners of speed over time.
    struct Corner {
        double time_s;
        double steps_per_s;
    };
    std::vector<Corner> corners() const;

private:
    StepMove move_;
    double peak_;
    double rise_steps_;
    double fall_steps_;
    double rise_s_;
    double cruise_s_;
    double fall_s_;
};

}  // namespace lockstep
