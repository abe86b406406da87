// The place at which an epoch came to rest.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/kinematics/places.hpp"
#include "core/motion/path.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

struct EpochEnd {
    enum class Kind : std::uint8_t {
        Complete,      // the path is done
        Interrupted,   // all axes ran the same frames and rest on the path, where they should
        FramesDiffer,  // the axes did not all run the same frames
        Misplaced,     // an axis is not where its frames end
        OffTouch,      // a motor does not rest where its pulses had to cease at the touch
    };
    Kind kind = Kind::Complete;
    MotorIndex motor;  // the motor that is elsewhere; meaningless if the machine rests on its path
    FrameNumber ran = 0;
    PathPlace place;           // on the program
    MotorPositions positions;  // exactly where the motors rest
    bool has_pulses = false;   // devices were told the places of the newest M69

    bool rests_on_path() const { return kind == Kind::Complete || kind == Kind::Interrupted; }
};

}  // namespace lockstep
