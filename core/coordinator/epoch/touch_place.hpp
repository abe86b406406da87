// The places at which motors rest whose pulses had to cease at a touch: those of the frames at the tick of the touch
// and the debounce. The coordinator and `lockstep verify` compare them with the counts.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "core/kinematics/places.hpp"
#include "core/machine.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// A motor that rests elsewhere, in steps.
struct OffTouch {
    MotorIndex motor;
    std::int64_t rests = 0;
    std::int64_t due = 0;
};

/// The first motor that does not rest where its pulses had to cease, within a tick, or within the errors of clocks that
/// are estimated; nullopt: all do, or the touch does not cease pulses. `touched`: the first touch of the epoch.
/// `places_at`: where the motors were by the frames that were run; after them they rest at their end.
std::optional<OffTouch> off_touch(const MachineConfig& machine, const TouchInputs& touch, Tick touched,
                                  const std::function<MotorPositions(Tick)>& places_at, const MotorPositions& rests);

}  // namespace lockstep
