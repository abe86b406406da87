// Compares the product of a counter and a reference speed with one: needs no timer and no division.
//
// Source: Daniel Carrica, Marcos A. Funes, Sergio A. González, "Novel stepper motor controller based on FPGA hardware
// implementation", Eqs. (5), (7), (9), (11) and Fig. 5. n counts clock periods T_c since the last step. A step
// occurs when
//   n V_ref T_c >= 1,                                                                                         (11)
// and n restarts at 0. V_ref is a trapezoid over time from V_min to V_max (Fig. 4). Only speeds 1/(n T_c) can be made,
// each at or below the reference; near speed V adjacent speeds differ by about V^2 T_c.
//
// The paper leaves the following open; chosen here: V_ref changes every T_c, in fixed point of 2^-60 step per T_c,
// or of fewer bits as in sim_fpga/rtl/carrica, rounded up so that a speed with a period of whole T_c gets exactly that
// period. It falls while the remaining steps are at most (V_ref^2 - V_min^2)/(2a), checked after each step. The steps
// are a little slower than the reference, so if it fell by time alone, it would reach V_min long before the last step.
#pragma once

#include "core/methods/method.hpp"

namespace lockstep::methods {

struct CarricaParameters {
    double clock_s = 800e-9;  // T_c of the experiment of Figs. 6 and 7; 400 ns for Fig. 8
    int fraction_bits = 60;   // V_ref is a multiple of 2^-fraction_bits step per T_c
};

/// The quantisation of speed near `steps_per_s`: the difference of the two next speeds 1/(n T_c) at or below it.
double carrica_speed_gap(double steps_per_s, double clock_s);

/// The times of steps, one after the other. Bisection finds the same wait, in clock periods, as counting would.
class CarricaSteps {
public:
    /// Returns the errors of carrica().
    static std::expected<CarricaSteps, StepError> of(const StepMove& move, Fit fit,
                                                     const CarricaParameters& parameters = {});

    /// Call it once for each step of the move.
    double next_s();
    double clock_s() const { return clock_s_; }
    const std::string& nearest() const { return nearest_; }

    /// V_ref, in units of 1/one step per clock period.
    struct Reference {
        std::int64_t one = 0;
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
    };
    const Reference& reference() const { return reference_; }

private:
    CarricaSteps(const StepMove& made, const CarricaParameters& parameters, std::string nearest);

    Reference reference_;
    double clock_s_;
    std::string nearest_;
    std::int64_t remaining_;
    std::int64_t now_ = 0;
};

/// Both ramps have the smaller of acceleration and deceleration. From rest it begins at sqrt(2a), the speed after one
/// step. Step k is at position k. Returns an error if the maximum is above 1/T_c.
StepResult carrica(const StepMove& move, Fit fit, const CarricaParameters& parameters = {});

}  // namespace lockstep::methods
