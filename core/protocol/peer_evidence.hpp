// What an axis has heard of one other axis, by stamp: the evidence of the check instant.
#pragma once

#include <array>
#include <cstddef>

#include "core/protocol/rules.hpp"

namespace lockstep {

/// The longest stall that a machine's file may allow for, in slots.
inline constexpr int kMaxStallSlots = 200;
/// Of each axis's states, on the network and in shared memory, for who stalls: more than are said meanwhile.
inline constexpr std::size_t kStatesKept = 256;
static_assert(kStatesKept > kMaxStallSlots);

class PeerEvidence {
public:
    /// States may come late, twice or out of order; only their stamps count.
    void hear(const AxisState& state) {
        Entry& entry = entries_[index(state.stamp)];
        if (entry.heard && entry.stamp >= state.stamp) { return; }
        entry = {true, state.stamp, state.epoch, state.held};
    }

    /// Whether a state stamped in the window of the frame that starts at `start` says that it holds k of `epoch`.
    bool holds(Epoch epoch, FrameNumber k, Slot start, const ProtocolTiming& timing) const {
        const Slot last = rules::last_evidence_slot(start, timing);
        for (Slot stamp = rules::first_evidence_slot(start, timing); stamp <= last; ++stamp) {
            const Entry& e = entries_[index(stamp)];
            if (e.heard && e.stamp == stamp && e.epoch == epoch && e.held >= k) { return true; }
        }
        return false;
    }

    /// Longest memory in slots: a configuration's m + V must stay below.
    static constexpr Slot kMemory = 512;

private:
    struct Entry {
        bool heard = false;
        Slot stamp = 0;
        Epoch epoch = 0;
        FrameNumber held = 0;
    };
    static constexpr std::size_t index(Slot stamp) { return static_cast<std::size_t>(stamp) % kMemory; }
    std::array<Entry, kMemory> entries_{};
};

}  // namespace lockstep
