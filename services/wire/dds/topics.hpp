// Every topic: its name, its type on the wire, and its delivery. No other file sets a quality of service.
//
// All are volatile: a message sent before a reader joined is never replayed to it. A command from an hour ago must
// not move a machine, and states and setpoints come again each slot.
//
// Setpoints are reliable: every frame is needed. Their history is 64 and never "all": a reader that stops taking must
// not stop the writer (in Cyclone DDS a keep-last writer never waits), and 64 cover a stall, after which the
// coordinator repeats the frames that are not held.
//
// States are best effort: each one contains the content of the one before and comes every slot, so a copy sent again
// would only be late, and acknowledgements between all pairs of axes would cost more than they give. Their history is
// kStatesKept per axis: after a stall the arming rule selects states by their stamps, not the newest.
//
// Commands, program parts and replies are reliable with a history of 64: a client has fewer than 64 unanswered.
//
// Events of programs are reliable: each comes once. Their history is 1024, since a program may switch often and a
// reader may be slow; what they have switched is in the machine's state, so a reader that lost some is not misled.
//
// Values that outlive programs are best effort: they come again several times a second.
//
// Health, clock requests and replies are best effort: a copy sent again would be out of date. Only the newest few
// matter.
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
