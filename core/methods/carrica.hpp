// A counter times a reference speed, compared with one: no timer and no division.
//
// Source: Daniel Carrica, Marcos A. Funes, Sergio A. González, "Novel stepper motor controller based on FPGA hardware
// implementation", Eqs. (5), (7), (9), (11) and Fig. 5. n counts clock periods T_c since the last step; a step falls
// where
//   n V_ref T_c >= 1,                                                                                         (11)
// and n restarts at 0. V_ref is a trapezoid over time from V_min to V_max (Fig. 4). Only speeds 1/(n T_c) can be made,
// each at or below the reference; near speed V neighbours are about V^2 T_c apart.
//
// Left open there and chosen here: V_ref changes every T_c, in fixed point of 2^-60 step per T_c, rounded up so that a
// speed whose period is a whole number of T_c gets exactly that period. It falls while the steps that remain are no
// more than (V_ref^2 - V_min^2)/(2a), looked at after each step: the steps made are a little slower than the reference,
// and one that fell by time alone would be at V_min long before the last step.
#pragma once

#include "core/methods/method.hpp"

namespace lockstep::methods {

struct CarricaParameters {
    double clock_s = 800e-9;  // T_c of the experiment of Figs. 6 and 7; 400 ns for Fig. 8
};

/// The speed next below 1/(n T_c), and how far it is: what the quantisation of speed costs near `steps_per_s`.
double carrica_speed_gap(double steps_per_s, double clock_s);

/// When steps fall, one after the other. A wait is found by bisection, to the clock period that counting would find.
class CarricaSteps {
public:
    /// Error: as carrica's.
    static std::expected<CarricaSteps, StepError> of(const StepMove& move, Fit fit,
                                                     const CarricaParameters& parameters = {});

    /// Call it for each of the move's steps once.
    double next_s();
    double clock_s() const { return clock_s_; }
    const std::string& nearest() const { return nearest_; }

private:
    /// V_ref, in 2^-60 steps per clock period.
    struct Reference {
        std::int64_t speed = 0;
        std::int64_t min = 0;
        std::int64_t max = 0;
        std::int64_t change = 0;  // per clock period
        enum class Slope { Rising, Level, Falling } slope = Slope::Rising;

        std::int64_t after(std::int64_t clocks) const;
        /// Whether n V_ref T_c >= 1 after `clocks`.
        bool steps_at(std::int64_t clocks) const;
        std::int64_t wait() const;
        void brake_for(std::int64_t remaining);
        double brake_steps() const;
    };
    CarricaSteps(const StepMove& made, double clock_s, std::string nearest);

    Reference reference_;
    double clock_s_;
    std::string nearest_;
    std::int64_t remaining_;
    std::int64_t now_ = 0;
};

/// One acceleration for both ramps: the smaller of the two. From rest it begins at sqrt(2a), the speed after one step.
/// Step k is where the position is k. Error: the maximum is above 1/T_c.
StepResult carrica(const StepMove& move, Fit fit, const CarricaParameters& parameters = {});

}  // namespace lockstep::methods
