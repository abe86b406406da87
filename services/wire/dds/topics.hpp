// Every topic: its name, its type on the wire, and how it is delivered. Nothing else sets a quality of service.
//
// All are volatile: what was said before somebody listened is never replayed to him. A command from an hour ago must
// not move a machine, and states and setpoints come again each slot.
//
// Setpoints are reliable: a frame is awaited. They are kept 64 deep and never "all": a reader that stops taking must
// not stop the writer (Cyclone DDS never makes a keep-last writer wait), and 64 outlast a stall, after which the
// coordinator repeats what is not held.
//
// States are best effort: each one contains all that the one before said and comes every slot, so a copy sent again
// would only be late, and acknowledgements between all pairs of axes cost more than they give. They are kept
// kStatesKept deep per axis: after a stall the arming rule looks for states by their stamps, not for the newest.
//
// Commands, program parts and replies are reliable and 64 deep: a client has fewer than 64 unanswered.
//
// Health, clock requests and replies are best effort: a copy sent again would tell what was. Only the newest few
// matter.
#pragma once

#include "core/protocol/axis_health.hpp"
#include "core/protocol/peer_evidence.hpp"
#include "idl/dds/axis.h"
#include "idl/dds/client.h"
#include "idl/dds/clock.h"
#include "idl/dds/health.h"
#include "idl/dds/machine.h"
#include "idl/dds/setpoint.h"

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
LOCKSTEP_TOPIC(ClockRequest, ClockRequest, {"lockstep/clock_request", kType, Delivery::BestEffort, 8})
LOCKSTEP_TOPIC(ClockReply, ClockReply, {"lockstep/clock_reply", kType, Delivery::BestEffort, 8})

#undef LOCKSTEP_TOPIC

}  // namespace lockstep
