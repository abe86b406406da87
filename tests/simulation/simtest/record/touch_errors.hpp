// How far the zeros of axes that home by touch can be off: the clocks that tell of the touch and of the steps are only
// estimated, and a contact that bounces closes for good a little later.
#pragma once

#include <vector>

#include "core/protocol/messages.hpp"
#include "tests/simulation/simtest/record/motor_shares.hpp"

namespace lockstep::simtest {

class TouchErrors {
public:
    explicit TouchErrors(const MachineConfig& machine)
        : machine_(machine), shares_(machine), published_(shares_.motors()), moving_(shares_.motors()) {}

    /// A state as its process publishes it.
    void note(MotorIndex motor, const AxisState& state);
    /// In steps of the motor, since it began to be homed.
    double steps(MotorIndex motor) const;

private:
    struct Moving {
        bool was_homed = true;
        Ticks error;  // the greatest of all clocks while it moves without being homed
    };

    MachineConfig machine_;
    MotorShares shares_;
    std::vector<Ticks> published_;  // the newest bound of each clock
    std::vector<Moving> moving_;
};

}  // namespace lockstep::simtest
