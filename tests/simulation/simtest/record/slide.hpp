// The slide of a motor with backlash, by the steps of the motor alone. It shares no code with
// core/kinematics/backlash.hpp.
//
// The motor pushes its slide with one of two flanks. Between them it turns without effect.
#pragma once

#include <cstdint>

namespace lockstep::simtest {

class Slide {
public:
    /// `play`: steps of the motor from one flank to the other; 0 without backlash.
    explicit Slide(std::int64_t play) : play_(play) {}

    /// A step of the motor, 1 or -1. Returns by how much the slide moves.
    std::int64_t take(std::int64_t step) {
        const std::int64_t next = from_lower_ + step;
        const bool pushes = next < 0 || next > play_;
        if (!pushes) { from_lower_ = next; }
        return pushes ? step : 0;
    }

private:
    std::int64_t play_;
    std::int64_t from_lower_ = 0;  // from where the motor pushes down; a homing goes through the whole play
};

}  // namespace lockstep::simtest
