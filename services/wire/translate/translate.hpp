// Translates core's messages to their types on the wire and back, with one function for each direction and type.
//
// Translation to the wire cannot fail, because core keeps its bounds. from_wire() checks each sample: counts must
// match, numbers must be in range, and choices must exist. Otherwise it refuses the sample with the field, its value
// and the reason.
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
inline constexpr std::uint32_t kMaxChunks = 1U << 24;  // the most chunks a program may have
/// The most bytes MachineValues may have.
inline constexpr std::size_t kMaxValuesBytes = lockstep_wire_MAX_VALUES_BYTES;

/// A setpoint and the arrays it points to. It is movable, because moved vectors keep their elements in place, but not
/// copyable.
struct SetpointMessage : lockstep_wire_Setpoint {
    SetpointMessage() : lockstep_wire_Setpoint{} {}
    SetpointMessage(SetpointMessage&&) = default;

    struct Storage {
        std::vector<std::int64_t> from_count;
        std::vector<std::uint64_t> from_phase;
        std::vector<std::uint16_t> body_count, tail_count;
        std::vector<std::int64_t> ticks, velocity, acceleration;
        std::vector<std::uint8_t> touch_motor, touch_channel;
        std::vector<std::uint8_t> output_motor;
        std::vector<std::uint16_t> output_body_count, output_tail_count;
        std::vector<std::int64_t> output_at;
        std::vector<std::uint8_t> output_channel;
        std::vector<std::int64_t> output_value, output_slope;
    } storage;
};

/// A machine state and the array it points to; not copyable either.
struct MachineStateMessage : lockstep_wire_MachineState {
    MachineStateMessage() : lockstep_wire_MachineState{} {
        rest_storage.reserve(kMaxRests);
        leg_storage.reserve(kMaxAxes);
    }
    MachineStateMessage(MachineStateMessage&&) = default;
    std::vector<lockstep_wire_FrameRest> rest_storage;
    std::vector<std::int64_t> place_storage;
    std::vector<std::int64_t> leg_storage;
    std::vector<double> probe_storage;
    std::vector<double> analog_storage;
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
/// The result points to the chunk's bytes and is valid only as long as they are. `chunk` has at most kMaxChunkBytes.
lockstep_wire_ProgramChunk to_wire(const ProgramChunk& chunk);
/// Cuts a text that is too long between two words or characters.
lockstep_wire_Reply to_wire(const Reply& reply);
lockstep_wire_ProgramEvent to_wire(const PublishedEvent& event);
/// The result points to the values' bytes and is valid only as long as they are. `values` has at most kMaxValuesBytes.
lockstep_wire_MachineValues to_wire(const MachineValues& values);

/// Does the same into a reused message.
template <typename T, typename Wire>
requires(!std::same_as<T, Frame> && !std::same_as<T, MachineState>) void to_wire(const T& value, Wire& into) {
    into = to_wire(value);
}
/// These allocate nothing if `into` has held at least this many pieces or rests before.
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

/// Does the same into a reused value, which keeps its content if the sample is refused.
template <typename Wire, typename T>
requires(!std::same_as<T, Frame> &&
         !std::same_as<T, MachineState>) std::expected<void, std::string> from_wire(const Wire& wire, T& into) {
    auto value = from_wire(wire);
    if (!value) { return std::unexpected(std::move(value.error())); }
    into = std::move(*value);
    return {};
}
/// A frame is large, so if `into` has the same number of axes, this allocates nothing and writes only the parts in use.
std::expected<void, std::string> from_wire(const lockstep_wire_Setpoint& wire, Frame& into);
/// Reuses the memory of the rests and of the writer's names.
std::expected<void, std::string> from_wire(const lockstep_wire_MachineState& wire, MachineState& into);

}  // namespace lockstep
