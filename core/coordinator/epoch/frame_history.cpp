#include "core/coordinator/epoch/frame_history.hpp"

#include <algorithm>
#include <utility>

namespace lockstep {
namespace {

/// Moves `at` along the pieces for at most `ticks`, and takes the time that they last from `ticks`.
void follow(const std::vector<Piece>& pieces, Ticks& ticks, Position& at) {
    for (const Piece& piece : pieces) {
        const Ticks lasts = std::min(piece.ticks, ticks);
        at = at + piece.covered(lasts);
        ticks = ticks - lasts;
    }
}

}  // namespace

void FrameHistory::begin(const MotorPositions& at) {
    rest_ = at;
    frames_.clear();
}

void FrameHistory::add(const Frame& frame) {
    if (frames_.size() == kFramesKept) { frames_.pop_front(); }
    frames_.renew_back([&](Kept&& old) {
        Kept kept{frame.number, frame.start, frame.ticks, std::move(old.tracks)};
        kept.tracks.resize(frame.axes.size());
        for (std::size_t i = 0; i < frame.axes.size(); ++i) {
            const AxisTrack& track = frame.axes[i];
            kept.tracks[i].from = track.from;
            kept.tracks[i].body.assign(track.body.begin(), track.body.end());
            kept.tracks[i].tail.assign(track.tail.begin(), track.tail.end());
        }
        return kept;
    });
}

MotorPositions FrameHistory::at(Tick tick, FrameNumber ran) const {
    const Kept* last = nullptr;  // the frame in whose body or tail the tick is
    for (std::size_t k = 0; k < frames_.size(); ++k) {
        const bool has_begun = frames_[k].start <= tick || last == nullptr;
        if (frames_[k].number <= ran && has_begun) { last = &frames_[k]; }
    }
    if (last == nullptr) { return rest_; }
    MotorPositions places;
    for (const Track& track : last->tracks) {
        Ticks left = std::max(tick - last->start, Ticks{});
        Position at = track.from;
        follow(track.body, left, at);
        if (last->number == ran) { follow(track.tail, left, at); }
        places.append(at);
    }
    return places;
}

}  // namespace lockstep
