// The timer recurrence: how many counts of a timer each step waits, from the wait before it.
//
// Source: Thomas Spielauer, "Linear stepper motor control - A summary", 2019. With step length alpha, timer frequency f
// and acceleration a (or -d):
//   counts of each phase  n_a = v^2/(2 a alpha), n_d = v^2/(2 d alpha), n_c the rest; where they exceed N, a triangle:
//                         n_a = N d/(a + d), n_d = N - n_a, v_max = sqrt(2 alpha N a d/(a + d))
//   first wait            c_0 = f sqrt(2 alpha/a); first while decelerating f (v - sqrt(v^2 - 2 d alpha))/d
//   every other           c_i = c_(i-1)/(1 + R c_(i-1)^2), R = a/(alpha f^2) or -d/(alpha f^2)
//   constant speed        c = alpha f/v
// The recurrence takes a wait's mean speed for the speed at its end, so the first and the last waits are off (the
// second is a third of the first; it should be 0.414 of it). The summary's empirical correction lengthens the first
// five by 1 + 0.08/i and the last five by 1 + 0.08/(n - i).
//
// Left open there and chosen here: numbers of steps are rounded down; a wait is rounded down when it is loaded (which
// gives 44,721 for 44,721.36), while the recurrence goes on from the unrounded one, since at high speeds a step changes
// the wait by less than a count; i counts the waits of the whole move from 0, and the first, where 0.08/i has no value,
// is not corrected. No decelerating wait is longer than f sqrt(2 alpha/d), the last one of an exact stop.
#pragma once

#include <cstdint>
#include <vector>

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

/// Speeds and accelerations in units of length; the start speed is not looked at.
SpielauerPlan plan_spielauer(const StepMove& move, double step_length = 1);

/// The timer's counts, step after step.
class SpielauerSteps {
public:
    /// The move must pass check() (method.hpp).
    explicit SpielauerSteps(const StepMove& move, const SpielauerParameters& parameters = {});
    /// The same where the method can make it. Error: as spielauer's.
    static std::expected<SpielauerSteps, StepError> of(const StepMove& move, Fit fit,
                                                       const SpielauerParameters& parameters = {});

    /// How long the next step is waited for. Call these two for each of the move's steps once.
    std::int64_t next_count();
    /// When the next step falls.
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
    double wait_ = 0;  // the last one of a ramp, before it is rounded
    std::int64_t now_ = 0;
};

/// The timer counts of each step, in order.
std::vector<std::int64_t> spielauer_counts(const StepMove& move, const SpielauerParameters& parameters = {});

/// Starts and ends at rest whatever the start speed. Step k is where the position is k. Error: faster than the timer.
StepResult spielauer(const StepMove& move, Fit fit, const SpielauerParameters& parameters = {});

}  // namespace lockstep::methods
