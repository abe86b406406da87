// Core's messages to their types on the wire and back: one function for each direction and type.
//
// To the wire nothing can fail: core keeps its bounds. A sample from the wire is checked: counts must match, numbers be
// in range, and choices exist, or the sample is refused with the field, its value and why.
#pragma once

#include <concepts>
#include <cstdint>
#include <expected>
#include <string>
#include <vector>

#include "core/protocol/axis_health.hpp"
#include "core/protocol/machine_values.hpp"
#include "idl/dds/axis.h"
#include "idl/dds/client.h"
#include "idl/dds/clock.h"
#include "idl/dds/event.h"
#include "idl/dds/health.h"
#include "idl/dds/machine.h"
#include "idl/dds/setpoint.h"
#include "idl/dds/values.h"

namespace lockstep {

/// The most bytes a ProgramChunk may have.
inline constexpr std::size_t kMaxChunkBytes = lockstep_wire_MAX_CHUNK_BYTES;
inline constexpr std::uint32_t kMaxChunks = 1U << 24;  // of a program
/// The most bytes MachineValues may have.
inline constexpr std::size_t kMaxValuesBytes = lockstep_wire_MAX_VALUES_BYTES;
/// The most chunks a program may have: 128 MB.

/// A setpoint and the arrays it points to. Movable, since vectors keep their elements' place; not copyable.
struct SetpointMessage : lockstep_wire_Setpoint {
    SetpointMessage() : lockstep_wire_Setpoint{} {}
    SetpointMessage(SetpointMessage&&) = default;

    struct Storage {
        std::vector<std::int64_t> from_count;
        std::vector<std::uint64_t> from_phase;
        std::vector<std::uint16_t> body_count, tail_count;
        std::vector<std::int64_t> ticks, velocity, acceleration;
    } storage;
};

/// A machine state and the arrays it points to; not copyable either.
struct MachineStateMessage : lockstep_wire_MachineState {
    MachineStateMessage() : lockstep_wire_MachineState{} {}
    MachineStateMessage(MachineStateMessage&&) = default;
    std::vector<lockstep_wire_FrameRest> rest_storage;
};

/// A command and the array it points to; not copyable either.
struct CommandMessage : lockstep_wire_Command {
    CommandMessage() : lockstep_wire_Command{} {}
    CommandMessage(CommandMessage&&) = default;
    CommandMessage& operator=(CommandMessage&&) = default;
    std::vector<lockstep_wire_JogAxis> jog_storage;
};

SetpointMessage to_wire(const Frame& frame);
lockstep_wire_AxisState to_wire(const AxisState& state);
lockstep_wire_AxisHealth to_wire(const AxisHealth& health);
lockstep_wire_AxisCommand to_wire(const AxisCommand& command);
MachineStateMessage to_wire(const MachineState& state);
lockstep_wire_ClockRequest to_wire(const ClockRequest& request);
lockstep_wire_ClockReply to_wire(const ClockReply& reply);
CommandMessage to_wire(const Command& command);
/// Points to the chunk's bytes: valid as long as they are. At most kMaxChunkBytes.
lockstep_wire_ProgramChunk to_wire(const ProgramChunk& chunk);
/// A text that is too long is cut between two characters.
lockstep_wire_Reply to_wire(const Reply& reply);
lockstep_wire_ProgramEvent to_wire(const PublishedEvent& event);
/// Points to the values' bytes: valid as long as they are. At most kMaxValuesBytes.
lockstep_wire_MachineValues to_wire(const MachineValues& values);

/// The same into a reused message.
template <typename T, typename Wire>
requires(!std::same_as<T, Frame> && !std::same_as<T, MachineState>) void to_wire(const T& value, Wire& into) {
    into = to_wire(value);
}
/// Nothing is allocated if `into` has held as many pieces, or rests, before.
void to_wire(const Frame& frame, SetpointMessage& into);
void to_wire(const MachineState& state, MachineStateMessage& into);

template <typename T>
using FromWire = std::expected<T, std::string>;

FromWire<Frame> from_wire(const lockstep_wire_Setpoint& wire);
FromWire<AxisState> from_wire(const lockstep_wire_AxisState& wire);
FromWire<AxisHealth> from_wire(const lockstep_wire_AxisHealth& wire);
FromWire<AxisCommand> from_wire(const lockstep_wire_AxisCommand& wire);
FromWire<MachineState> from_wire(const lockstep_wire_MachineState& wire);
FromWire<ClockRequest> from_wire(const lockstep_wire_ClockRequest& wire);
FromWire<ClockReply> from_wire(const lockstep_wire_ClockReply& wire);
FromWire<Command> from_wire(const lockstep_wire_Command& wire);
FromWire<ProgramChunk> from_wire(const lockstep_wire_ProgramChunk& wire);
FromWire<Reply> from_wire(const lockstep_wire_Reply& wire);
FromWire<PublishedEvent> from_wire(const lockstep_wire_ProgramEvent& wire);
FromWire<MachineValues> from_wire(const lockstep_wire_MachineValues& wire);

/// The same into a reused value; it keeps its content if the sample is refused.
template <typename Wire, typename T>
requires(!std::same_as<T, Frame> &&
         !std::same_as<T, MachineState>) std::expected<void, std::string> from_wire(const Wire& wire, T& into) {
    auto value = from_wire(wire);
    if (!value) { return std::unexpected(std::move(value.error())); }
    into = std::move(*value);
    return {};
}
/// A frame is large: if `into` has as many axes nothing is allocated and only the parts in use are written.
std::expected<void, std::string> from_wire(const lockstep_wire_Setpoint& wire, Frame& into);
/// The memory of the rests and of the writer's names is used again.
std::expected<void, std::string> from_wire(const lockstep_wire_MachineState& wire, MachineState& into);

}  // namespace lockstep
