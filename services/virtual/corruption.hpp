// Alters messages in transit into ones that no correct process sends and that every receiver must refuse.
//
// A receiver can detect each alteration from the message alone or from its own knowledge. It cannot detect a frame that
// was altered into another legal frame. The carrier's checksums protect against that.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string_view>
#include <variant>

#include "core/enumeration.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

using VirtualMessage =
    std::variant<Frame, AxisState, MachineState, AxisCommand, Command, ProgramPart, Reply, ClockRequest, ClockReply>;

enum class Alteration : std::uint8_t {
    None,           // this kind of message is never altered
    FrameEpoch,     // a near epoch number, or an absurd one
    FrameSequence,  // out of order
    FrameStart,     // between slots
    FrameTicks,     // a length that differs from that of its pieces
    FrameFrom,      // one axis starts at a place where it is not
    FrameSpeed,     // one piece is beyond every limit
    FrameAbsurd,    // one piece has random numbers
    FrameTravel,    // one axis is far outside its travel
    FrameAxes,      // one track too many or too few
    FrameTerm,      // the term of an unknown owner
    StateAxis,      // the number of another axis
    StateStamp,     // a stamp long past, or far in the future
    StateIdentity,  // the identity of an unknown process
    StatePosition,  // a position that is not the axis's
    StateTerm,      // the term of an unknown owner
    MachineTerm,    // the term of an unknown owner
    CommandTerm,    // an order to an axis, with the term of an unknown coordinator
};
inline constexpr std::size_t kAlterations = kCountOf<Alteration>;
using AlterationCounts = std::array<std::uint64_t, kAlterations>;

std::string_view name_of(Alteration alteration);

/// Alters the message in a random way of those possible for its type. Returns the way.
Alteration alter(VirtualMessage& message, std::mt19937_64& random);

}  // namespace lockstep
