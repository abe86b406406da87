// Frames that an axis holds until its device has run them.
#pragma once

#include <algorithm>
#include <deque>
#include <utility>

#include "core/protocol/messages.hpp"

namespace lockstep {

/// A frame as one axis keeps it: its own track only, in machine coordinates.
struct HeldFrame {
    FrameNumber number = 0;
    Tick start;
    Ticks ticks;
    bool last = false;
    AxisTrack track;
    Tick end() const { return start + ticks; }
    Position body_end() const {
        Position at = track.from;
        for (const Piece& piece : track.body) { at = at + piece.covered(); }
        return at;
    }
};

/// In order of their numbers.
class HeldFrames {
public:
    void push_back(const HeldFrame& frame) { frames_.push_back(frame); }
    void forget_before(FrameNumber number) {
        while (!frames_.empty() && frames_.front().number < number) { frames_.pop_front(); }
    }
    void clear() { frames_.clear(); }

    /// Null: it is not held.
    const HeldFrame* find(FrameNumber number) const {
        const auto found = std::ranges::find(frames_, number, &HeldFrame::number);
        return found == frames_.end() ? nullptr : &*found;
    }
    const HeldFrame& front() const { return frames_.front(); }
    const HeldFrame& back() const { return frames_.back(); }
    bool empty() const { return frames_.empty(); }
    std::size_t size() const { return frames_.size(); }

private:
    std::deque<HeldFrame> frames_;
};

}  // namespace lockstep
