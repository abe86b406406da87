// How many frames a machine's timing sends ahead, and how many pieces each frame may have.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/protocol/messages.hpp"
#include "core/protocol/timing.hpp"

namespace lockstep {

/// Entries that a device's segment ring must have (sim_fpga/registers.json).
inline constexpr int kDeviceRingEntries = 1024;
/// Entries that a device's capture ring must have: steps whose times it keeps until the axis's process reads them.
inline constexpr int kDeviceCaptureEntries = 65'536;
/// The greatest number of frames that an axis keeps.
inline constexpr std::size_t kMaxFramesKept = 16;
/// A frame is fitted to its device's clock. This can add one piece to its body and one to its tail.
inline constexpr std::size_t kDevicePieces = 2;
/// The entry of the segment ring with which a frame begins.
inline constexpr std::size_t kFrameHeaders = 1;
/// Entries of the segment ring that a frame takes.
inline std::size_t ring_entries(const AxisTrack& track) {
    return kFrameHeaders + track.body.size() + track.tail.size();
}
/// A timing that leaves a frame fewer pieces is not useful.
inline constexpr int kLeastBodyPieces = 32;

/// The greatest number of frames that have been sent and have not begun.
constexpr int frames_ahead(const ProtocolTiming& t) {
    return (t.send_ahead_slots + t.frame_slots - 1) / t.frame_slots + 1;
}

/// Entries of a device's output ring: changes of outputs in the frames that are sent ahead.
inline constexpr int kDeviceOutputEntries = 1024;
/// How many changes of outputs a frame may have for each motor.
struct OutputRoom {
    std::size_t body = 0;
    std::size_t tail = 0;
};
constexpr OutputRoom output_room(const ProtocolTiming& t) {
    const auto room = static_cast<std::size_t>(kDeviceOutputEntries / frames_ahead(t));
    const std::size_t tail = std::min(room / 4, OutputTrack::kMostInTail);
    return {std::min(room - tail, OutputTrack::kMostInBody), tail};
}

/// How many pieces the body of a frame may have for each axis. The device's ring then has room for all frames ahead,
/// with their headers, their tails and kDevicePieces. If the result is below kLeastBodyPieces, too many frames are
/// ahead.
constexpr int body_pieces(const ProtocolTiming& t) {
    constexpr std::size_t kOthers = kFrameHeaders + kMaxTailPieces + kDevicePieces;
    const int room = kDeviceRingEntries / frames_ahead(t) - static_cast<int>(kOthers);
    return std::min(room, static_cast<int>(kMaxBodyPieces));
}

/// The shortest frame, in slots, that the timing's send-ahead allows.
constexpr int least_frame_slots(ProtocolTiming t) {
    for (t.frame_slots = 1; body_pieces(t) < kLeastBodyPieces || frames_ahead(t) + 2 > int{kMaxFramesKept};) {
        ++t.frame_slots;
    }
    return t.frame_slots;
}

/// Returns the timing with the shortest m and A for its slot, s and e. Its frames become longer only if these times
/// require it.
constexpr ProtocolTiming with_least_times(ProtocolTiming t) {
    t.freshness_slots = RULE_LEAST_FRESHNESS(t.stall_slots);
    t.send_ahead_slots = RULE_LEAST_SEND_AHEAD(t.check_slots(), t.freshness_slots, t.stall_slots);
    t.frame_slots = std::max(t.frame_slots, least_frame_slots(t));
    return t;
}

}  // namespace lockstep
