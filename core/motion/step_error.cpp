#include "core/motion/step_error.hpp"

#include "core/number_text.hpp"

namespace lockstep {

std::string text_of(const StepError& error) {
    using enum StepError::Why;
    const std::string most = short_number(error.most);
    switch (error.why) {
        case StepCount: return "a move has 1 to " + most + " steps";
        case MaxSpeed: return "the maximum speed must be above 0";
        case StartSpeed: return "the start speed must not be below 0";
        case StartAboveMax: return "the start speed must not be above the maximum";
        case Acceleration: return "acceleration and deceleration must be above 0";
        case TooFast:
            return "with the method's clock a step takes at least " + short_number(1e6 / error.most) +
                   " us: the maximum speed must be below " + most + " steps/s";
        case TooSlow:
            return "the move is too slow for a clock of " + short_number(error.clock_s * 1e6) +
                   " us: it takes more than " + most + " s; take fewer steps";
        case PulsesPerPeriod:
            return "speeds are 1 to 255 whole pulses per " + short_number(error.clock_s * 1e3) +
                   " ms: the maximum must be " + short_number(error.least) + " to " + most + " steps/s";
        case Inexact: return error.nearest;
        case NoSingleSteps: break;
    }
    return "moves of this method are pieces, not single steps";
}

}  // namespace lockstep
