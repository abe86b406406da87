// How many frames a machine's timing sends ahead, and how many pieces each frame may have.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/protocol/messages.hpp"
#include "core/protocol/timing.hpp"

namespace lockstep {

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
/// The greatest number of frames that have been sent and have not begun.
constexpr int frames_ahead(const ProtocolTiming& t) {
    return (t.send_ahead_slots + t.frame_slots - 1) / t.frame_slots + 1;
}

/// How many changes of outputs a frame may have for each motor.
struct OutputRoom {
    std::size_t body = 0;
    std::size_t tail = 0;
};
constexpr OutputRoom output_room(const ProtocolTiming& t) {
    const auto room = static_cast<std::size_t>(t.output_entries / frames_ahead(t));
    constexpr std::size_t kHalfUpTo = 25;  // of a small ring's room a tail has half
    const std::size_t tail = std::min(std::max(room / 4, std::min(room / 2, kHalfUpTo)), OutputTrack::kMostInTail);
    return {std::min(room - tail, OutputTrack::kMostInBody), tail};
}

/// How many pieces a frame may have for each axis. A device's ring then has room for all frames ahead, with their
/// headers and kDevicePieces.
constexpr int frame_pieces(const ProtocolTiming& t) {
    return t.segment_entries / frames_ahead(t) - static_cast<int>(kFrameHeaders + kDevicePieces);
}
/// How many of them its tail may have: in small rings five of eight.
constexpr int tail_pieces(const ProtocolTiming& t) {
    return std::min(frame_pieces(t) * 5 / 8, static_cast<int>(kMaxTailPieces));
}
/// How many of them its body may have.
constexpr int body_pieces(const ProtocolTiming& t) {
    return std::min(frame_pieces(t) - tail_pieces(t), static_cast<int>(kMaxBodyPieces));
}
/// The entries of a device's ring that all frames ahead take, if they have all these pieces.
constexpr int needed_entries(const ProtocolTiming& t) {
    constexpr int kOthers = static_cast<int>(kFrameHeaders + kDevicePieces);
    return frames_ahead(t) * (kOthers + body_pieces(t) + tail_pieces(t));
}
/// How many pieces the body of a frame of an axis's own move may have: four such frames fit into the ring.
inline constexpr std::size_t kMostOwnBodyPieces = kMaxBodyPieces + 1;
constexpr std::size_t own_body_pieces(const ProtocolTiming& t) {
    constexpr std::size_t kOwnTailPieces = 1;
    const auto frame = static_cast<std::size_t>(t.segment_entries / 4);
    return std::min(frame - kFrameHeaders - kOwnTailPieces, kMostOwnBodyPieces);
}

/// A timing that leaves a frame fewer pieces, or sends more frames ahead, is not useful.
inline constexpr int kLeastFramePieces = 24;
inline constexpr int kMostFramesAhead = 10;
static_assert(kMostFramesAhead + 2 <= int{kMaxFramesKept});
/// With fewer entries no timing is useful: two frames are ahead at least.
inline constexpr int kLeastSegmentEntries = 2 * (kLeastFramePieces + static_cast<int>(kFrameHeaders + kDevicePieces));

/// The shortest frame, in slots, that the timing's send-ahead allows. Rings must have kLeastSegmentEntries.
constexpr int least_frame_slots(ProtocolTiming t) {
    t.frame_slots = 1;
    while (frames_ahead(t) > kMostFramesAhead || frame_pieces(t) < kLeastFramePieces) { ++t.frame_slots; }
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
