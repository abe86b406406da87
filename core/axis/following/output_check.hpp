// The axis does not trust the coordinator with outputs either. It checks their changes before it holds a frame.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/faults.hpp"
#include "core/hardware/output_change.hpp"
#include "core/machine.hpp"
#include "core/protocol/frame_room.hpp"

namespace lockstep {

class OutputCheck {
public:
    OutputCheck(MotorIndex motor, const MachineConfig& machine);

    /// Returns OutputsImpossible if a change is not of an output of this motor's device, is out of order or outside its
    /// body or tail, or has an impossible value, or if there are more than a frame has room for.
    FaultCode check(const OutputTrack& track, Ticks body, Ticks tail) const;

private:
    bool is_possible(const OutputChange& change) const;

    std::uint16_t digital_ = 0;  // output n is bit n
    std::uint16_t analog_ = 0;
    std::uint16_t pulses_ = 0;
    OutputRoom room_;
};

}  // namespace lockstep
