// Messages altered on their way: what no sender would say, and every receiver must see through.
//
// Each alteration can be told from the message alone, or from what its receiver knows. A frame altered into another
// that is legal in itself cannot: against that the carrier has its checksums.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string_view>
#include <variant>

#include "core/protocol/messages.hpp"

namespace lockstep {

using VirtualMessage =
    std::variant<Frame, AxisState, MachineState, AxisCommand, Command, ProgramPart, Reply, ClockRequest, ClockReply>;

enum class Alteration : std::uint8_t {
    None,           // the message has nothing that could be altered so
    FrameEpoch,     // of an epoch near by, or an absurd one
    FrameSequence,  // out of order
    FrameStart,     // between slots
    FrameTicks,     // another length than its pieces have
    FrameFrom,      // one axis starts elsewhere than it is
    FrameSpeed,     // one piece is beyond every limit
    FrameAbsurd,    // one piece is of numbers that mean nothing
    FrameTravel,    // one axis far outside its travel
    FrameAxes,      // a track too many or too few
    FrameTerm,      // of an owner that no process knows
    StateAxis,      // said in another axis's name
    StateStamp,     // long past, or far ahead
    StateIdentity,  // of a process that no process knows
    StatePosition,  // of an axis that is elsewhere
    StateTerm,      // of an axis that follows an unknown owner
    MachineTerm,    // of an owner that no process knows
    CommandTerm,    // to an axis, of a coordinator that no process knows
};
inline constexpr std::size_t kAlterations = 18;
using AlterationCounts = std::array<std::uint64_t, kAlterations>;

std::string_view name_of(Alteration alteration);

/// Alters the message in a way drawn from those its kind has. Returns which.
Alteration alter(VirtualMessage& message, std::mt19937_64& random);

}  // namespace lockstep
