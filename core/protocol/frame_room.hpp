// How many frames a machine's timing keeps ahead, and how many pieces each may therefore have.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/protocol/messages.hpp"
#include "core/protocol/timing.hpp"

namespace lockstep {

/// Entries of a device's segment ring (sim_fpga/registers.json).
inline constexpr int kDeviceRingEntries = 1024;
/// The most frames that an axis keeps.
inline constexpr std::size_t kMaxFramesKept = 16;
/// A frame is fitted to its device's clock. This can add one piece to its body and one to its tail.
inline constexpr std::size_t kDevicePieces = 2;
/// Fewer pieces in a frame are not worth a configuration.
inline constexpr int kLeastBodyPieces = 32;

/// How many frames have been sent and have not begun, at most.
constexpr int frames_ahead(const ProtocolTiming& t) {
    return (t.send_ahead_slots + t.frame_slots - 1) / t.frame_slots + 1;
}

/// How many pieces the body of a frame may have for each axis, so that all frames ahead, with their tails and the piece
/// more that each may need for its device, have room in the device's ring. Below kLeastBodyPieces: too many are ahead.
constexpr int body_pieces(const ProtocolTiming& t) {
    const int room = kDeviceRingEntries / frames_ahead(t) - static_cast<int>(kMaxTailPieces + kDevicePieces);
    return std::min(room, static_cast<int>(kMaxBodyPieces));
}

/// The shortest frame for a send-ahead.
constexpr int least_frame_slots(ProtocolTiming t) {
    for (t.frame_slots = 1; body_pieces(t) < kLeastBodyPieces || frames_ahead(t) + 2 > int{kMaxFramesKept};) {
        ++t.frame_slots;
    }
    return t.frame_slots;
}

/// With the shortest times for its slot, s and e; and frames that are no shorter than asked, nor than these times
/// allow.
constexpr ProtocolTiming with_least_times(ProtocolTiming t) {
    t.freshness_slots = RULE_LEAST_FRESHNESS(t.stall_slots);
    t.send_ahead_slots = RULE_LEAST_SEND_AHEAD(t.check_slots(), t.freshness_slots, t.stall_slots);
    t.frame_slots = std::max(t.frame_slots, least_frame_slots(t));
    return t;
}

}  // namespace lockstep
