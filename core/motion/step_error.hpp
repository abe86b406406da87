// Why a method of step generation cannot make a move.
#pragma once

#include <cstdint>
#include <string>

namespace lockstep {

struct StepError {
    enum class Why : std::uint8_t {
        StepCount,        // not 1 to `most`
        MaxSpeed,         // not above 0
        StartSpeed,       // below 0
        StartAboveMax,    // start speed above the maximum
        Acceleration,     // acceleration or deceleration not above 0
        TooFast,          // maximum above `most` steps/s, the greatest speed of the method's clock
        TooSlow,          // longer than `most` s, the longest move with a clock of `clock_s`
        PulsesPerPeriod,  // whole pulses per `clock_s`: the maximum is not within `least` to `most` steps/s
        Inexact,          // the method cannot make this move, but `nearest`
        NoSingleSteps,    // the method makes pieces
    };
    Why why;
    double clock_s = 0;
    double least = 0;
    double most = 0;
    std::string nearest;  // the changes to the move
};

/// Text for a person: the reason, and the possible values.
std::string text_of(const StepError& error);

}  // namespace lockstep
