// The table of all topics, with name, type on the wire, and delivery. No other file sets the quality of service of a
// topic.
//
// All topics are volatile: a reader never receives messages sent before it joined. A command from an hour ago must not
// move a machine, and states and setpoints are repeated each slot.
//
// Setpoints are reliable, because every frame is needed. Their history is 64, never "all", because a reader that stops
// taking must not stop the writer (in Cyclone DDS a keep-last writer never waits). 64 frames cover a stall. After it
// the coordinator repeats the frames that are not held.
//
// States are best effort. Each state replaces the one before and comes every slot, so a repeated copy would be late,
// and acknowledgements between all pairs of axes would cost more than they give. Their history is kStatesKept per axis,
// because after a stall the arming rule selects states by their stamps, not the newest.
//
// Commands, program parts and replies are reliable with a history of 64, because a client has fewer than 64 unanswered.
//
// Events of programs are reliable, because each is sent only once. Their history is 1024, since a program may switch
// often and a reader may be slow. The machine's state contains the present switch states, so a reader that lost events
// still has the correct state.
//
// Values that outlive programs are best effort, because they are repeated several times a second.
//
// Health, clock requests and clock replies are best effort, because a repeated copy would be out of date. Only the
// newest few matter.
#pragma once

#include "core/protocol/axis_health.hpp"
#include "core/protocol/machine_values.hpp"
#include "core/protocol/peer_evidence.hpp"
#include "idl/dds/axis.h"
#include "idl/dds/client.h"
#include "idl/dds/clock.h"
#include "idl/dds/event.h"
#include "idl/dds/health.h"
#include "idl/dds/machine.h"
#include "idl/dds/setpoint.h"
#include "idl/dds/values.h"

namespace lockstep {

enum class Delivery { BestEffort, Reliable };

struct TopicSpec {
    const char* name;
    const dds_topic_descriptor_t* type;
    Delivery delivery;
    int depth;  // samples kept per key
};

/// The topic that carries T, and its type on the wire.
template <typename T>
struct Topic;

#define LOCKSTEP_TOPIC(CORE, WIRE, ...)                                    \
    template <>                                                            \
    struct Topic<CORE> {                                                   \
        using Wire = lockstep_wire_##WIRE;                                 \
        static constexpr const auto* kType = &lockstep_wire_##WIRE##_desc; \
        static constexpr TopicSpec kSpec __VA_ARGS__;                      \
    };

LOCKSTEP_TOPIC(Frame, Setpoint, {"lockstep/setpoint", kType, Delivery::Reliable, 64})
LOCKSTEP_TOPIC(AxisState, AxisState, {"lockstep/axis_state", kType, Delivery::BestEffort, kStatesKept})
LOCKSTEP_TOPIC(AxisHealth, AxisHealth, {"lockstep/axis_health", kType, Delivery::BestEffort, 8})
LOCKSTEP_TOPIC(AxisCommand, AxisCommand, {"lockstep/axis_command", kType, Delivery::Reliable, 64})
LOCKSTEP_TOPIC(MachineState, MachineState, {"lockstep/machine_state", kType, Delivery::BestEffort, kStatesKept})
LOCKSTEP_TOPIC(Command, Command, {"lockstep/command", kType, Delivery::Reliable, 64})
LOCKSTEP_TOPIC(ProgramChunk, ProgramChunk, {"lockstep/program", kType, Delivery::Reliable, 64})
LOCKSTEP_TOPIC(Reply, Reply, {"lockstep/reply", kType, Delivery::Reliable, 64})
LOCKSTEP_TOPIC(PublishedEvent, ProgramEvent, {"lockstep/event", kType, Delivery::Reliable, 1024})
LOCKSTEP_TOPIC(MachineValues, MachineValues, {"lockstep/values", kType, Delivery::BestEffort, 1})
LOCKSTEP_TOPIC(ClockRequest, ClockRequest, {"lockstep/clock_request", kType, Delivery::BestEffort, 8})
LOCKSTEP_TOPIC(ClockReply, ClockReply, {"lockstep/clock_reply", kType, Delivery::BestEffort, 8})

#undef LOCKSTEP_TOPIC

}  // namespace lockstep
