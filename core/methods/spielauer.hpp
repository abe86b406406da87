// The timer recurrence: computes the wait of each step, in counts of a timer, from the previous wait.
//
// Source: Thomas Spielauer, "Linear stepper motor control - A summary", 2019. With step length alpha, timer frequency f
// and acceleration a (or -d):
//   counts of each phase  n_a = v^2/(2 a alpha), n_d = v^2/(2 d alpha), n_c the rest; if they exceed N, a triangle:
//                         n_a = N d/(a + d), n_d = N - n_a, v_max = sqrt(2 alpha N a d/(a + d))
//   first wait            c_0 = f sqrt(2 alpha/a); first while decelerating f (v - sqrt(v^2 - 2 d alpha))/d
//   every other           c_i = c_(i-1)/(1 + R c_(i-1)^2), R = a/(alpha f^2) or -d/(alpha f^2)
//   constant speed        c = alpha f/v
// The recurrence takes a wait's mean speed for the speed at its end, so the first and the last waits are off (the
// second is a third of the first; it should be 0.414 of it). The summary's empirical correction lengthens the first
// five by 1 + 0.08/i and the last five by 1 + 0.08/(n - i).
//
// The summary leaves the following open; chosen here: Numbers of steps are rounded down. A wait is rounded down when it
// is loaded (44,721.36 becomes 44,721), but the recurrence continues from the unrounded wait, since at high speeds a
// step changes the wait by less than a count. i counts the waits of the whole move from 0. The first wait is not
// corrected, since 0.08/i has no value for it. No decelerating wait is longer than f sqrt(2 alpha/d), the last one of
// an exact stop. No wait is shorter than one at the maximum speed, which the waits of n_a steps would exceed.
#pragma once

#include <cstdint>

#include "core/methods/method.hpp"

namespace lockstep::methods {

struct SpielauerParameters {
    double timer_hz = 1e6;
    double step_length = 1;  // alpha, in the unit of length of speeds and accelerations: a step
    bool corrected = false;  // with the empirical factors
};

struct SpielauerPlan {
    std::int64_t rising = 0;    // n_a
    std::int64_t cruising = 0;  // n_c
    std::int64_t falling = 0;   // n_d
    double peak = 0;            // v_d, or v_max of a triangle
    bool operator==(const SpielauerPlan&) const = default;
};

/// Speeds and accelerations are in units of length. The start speed is ignored.
SpielauerPlan plan_spielauer(const StepMove& move, double step_length = 1);

/// The timer's counts, step after step.
class SpielauerSteps {
public:
    /// The move must pass check() (method.hpp).
    explicit SpielauerSteps(const StepMove& move, const SpielauerParameters& parameters = {});
    /// Checks the move too. Returns the errors of spielauer().
    static std::expected<SpielauerSteps, StepError> of(const StepMove& move, Fit fit,
                                                       const SpielauerParameters& parameters = {});

    /// The wait for the next step, in counts. Call this or next_s() once for each step of the move.
    std::int64_t next_count();
    /// The time of the next step.
    double next_s();
    double clock_s() const { return 1 / parameters_.timer_hz; }
    const std::string& nearest() const { return nearest_; }

private:
    double next_wait();
    double corrected(double count) const;
    double followed(double wait, double acceleration) const;

    StepMove move_;
    SpielauerParameters parameters_;
    SpielauerPlan plan_;
    std::string nearest_;
    std::int64_t made_ = 0;
    double wait_ = 0;  // the last one of a ramp, before rounding
    std::int64_t now_ = 0;
};

/// Ignores the start speed: starts and ends at rest. Step k is at position k. Returns an error if it is faster than the
/// timer.
StepResult spielauer(const StepMove& move, Fit fit, const SpielauerParameters& parameters = {});

}  // namespace lockstep::methods
