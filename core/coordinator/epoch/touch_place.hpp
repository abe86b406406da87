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

/// A motor that does not rest where it should; places in steps.
struct OffTouch {
    MotorIndex motor;
    std::int64_t rests = 0;
    std::int64_t due = 0;
};

/// The frames of an epoch that were run.
struct RunFrames {
    Tick begin;
    std::function<MotorPositions(Tick)> places_at;  // after them the motors rest at their end
};

/// The first motor that does not rest where its pulses had to cease, within a tick, or within the errors of clocks that
/// are estimated; nullopt: all do, or the touch does not cease pulses. `touched`: the first touch of the epoch. If that
/// was before the frames begin, a contact that bounces may be open at their begin and cease the pulses later.
std::optional<OffTouch> off_touch(const MachineConfig& machine, const TouchInputs& touch, Tick touched,
                                  const RunFrames& ran, const MotorPositions& rests);

}  // namespace lockstep
