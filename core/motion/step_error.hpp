// Why a method of step generation cannot make a move.
#pragma once

#include <cstdint>
#include <string>

namespace lockstep {

struct StepError {
    enum class Why : std::uint8_t {
        StepCount,        // none, or more than `most`
        MaxSpeed,         // not above 0
        StartSpeed,       // below 0
        StartAboveMax,    // the start speed
        Acceleration,     // or deceleration: not above 0
        TooFast,          // the maximum is above what the method's clock can make, `most` steps/s
        TooSlow,          // by a clock of `clock_s` it is followed for `most` s only
        PulsesPerPeriod,  // of `clock_s`, whole ones: the maximum is not within `least` and `most` steps/s
        Inexact,          // the method can make only the `nearest`
        NoSingleSteps,    // its moves are pieces
    };
    Why why;
    double clock_s = 0;
    double least = 0;
    double most = 0;
    std::string nearest;  // what would be changed of the move
};

/// What the method cannot do, and what would be possible.
std::string text_of(const StepError& error);

}  // namespace lockstep
