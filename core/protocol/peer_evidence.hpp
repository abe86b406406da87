// Evidence that another process holds a frame.
#pragma once

#include <cstddef>
#include <limits>

#include "core/protocol/rules.hpp"

namespace lockstep {

/// The longest stall that a machine's file may allow for, in slots.
inline constexpr int kMaxStallSlots = 200;
/// How many states of each axis the network and the shared memory keep for a process that stalls. This is more than an
/// axis publishes during the longest stall.
inline constexpr std::size_t kStatesKept = 256;
static_assert(kStatesKept > kMaxStallSlots);

/// The newest state of the other process decides, because within an epoch no process gives up a frame that it holds.
class PeerEvidence {
public:
    /// States may be received late, twice or out of order; only their stamps count. `held`: every frame up to this one.
    void receive(Slot stamp, Epoch epoch, FrameNumber held) {
        if (stamp >= stamp_) { *this = {stamp, epoch, held}; }
    }

    /// Whether the process holds k according to a state that is evidence for a frame of `epoch` that starts at `start`.
    bool holds(Epoch epoch, FrameNumber k, Slot start, const ProtocolTiming& timing) const {
        return rules::is_evidence(stamp_, start, timing) && epoch_ == epoch && held_ >= k;
    }

    PeerEvidence() = default;

private:
    PeerEvidence(Slot stamp, Epoch epoch, FrameNumber held) : stamp_(stamp), epoch_(epoch), held_(held) {}
    Slot stamp_ = std::numeric_limits<Slot>::min();
    Epoch epoch_ = 0;
    FrameNumber held_ = 0;
};

}  // namespace lockstep
