#include "core/axis/state/followed_play.hpp"

namespace lockstep {
namespace {

/// The tick at which the motion of a piece turns, or its end.
Ticks turn_of(const Piece& piece) {
    if (piece.acceleration.raw == 0) { return piece.ticks; }
    const Int128 at = -Int128{piece.velocity.raw} / piece.acceleration.raw;
    return at > 0 && at < piece.ticks.value ? Ticks{static_cast<std::int64_t>(at)} : piece.ticks;
}

}  // namespace

/// Pulses that ceased early count as one motion: then the axis homes, or must be homed.
void FollowedPlay::follow(const ExecutedTrack& track) {
    Position at = track.from;
    std::int64_t count = at.count();
    const auto go_to = [&](std::int64_t to) {
        play_.follow(to - count);
        count = to;
    };
    if (track.cut) { go_to(track.stop_count); }
    for (std::size_t k = 0; k < track.pieces.size() && !track.cut; ++k) {
        const Piece& piece = track.pieces[k];
        go_to((at + piece.covered(turn_of(piece))).count());
        at = at + piece.covered();
        go_to(at.count());
    }
    count_ = track.stop_count + track.zero_count;
}

}  // namespace lockstep
