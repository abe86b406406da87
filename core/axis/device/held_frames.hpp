// Frames that an axis holds until its device has run them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/protocol/messages.hpp"

namespace lockstep {

/// A frame as one axis keeps it: its own track only, in machine coordinates.
struct HeldFrame {
    FrameNumber number = 0;
    Tick start;
    Ticks ticks;
    bool last = false;
    AxisTrack track;
    OutputTrack outputs;
    Tick end() const { return start + ticks; }
    Position body_end() const {
        Position at = track.from;
        for (const Piece& piece : track.body) { at = at + piece.covered(); }
        return at;
    }
};

/// Frames in order of their numbers, in a ring. Adding and dropping frames allocates nothing.
class HeldFrames {
public:
    /// `room`: the number of frames for which the ring has room. It grows if there are more.
    explicit HeldFrames(std::size_t room) : frames_(room) {}

    void push_back(const HeldFrame& frame) {
        if (size_ == frames_.size()) { grow(); }
        at(size_++) = frame;
    }
    void forget_before(FrameNumber number) {
        while (!empty() && front().number < number) {
            first_ = (first_ + 1) % frames_.size();
            --size_;
        }
    }
    void clear() { size_ = 0; }

    /// Returns null if the frame is not held.
    const HeldFrame* find(FrameNumber number) const {
        for (std::size_t i = 0; i < size_; ++i) {
            if (at(i).number == number) { return &at(i); }
        }
        return nullptr;
    }
    const HeldFrame& front() const { return at(0); }
    const HeldFrame& back() const { return at(size_ - 1); }
    bool empty() const { return size_ == 0; }
    std::size_t size() const { return size_; }

private:
    HeldFrame& at(std::size_t i) { return frames_[(first_ + i) % frames_.size()]; }
    const HeldFrame& at(std::size_t i) const { return frames_[(first_ + i) % frames_.size()]; }
    void grow() {
        std::rotate(frames_.begin(), frames_.begin() + static_cast<std::ptrdiff_t>(first_), frames_.end());
        first_ = 0;
        frames_.resize(2 * frames_.size() + 1);
    }

    std::vector<HeldFrame> frames_;
    std::size_t first_ = 0;
    std::size_t size_ = 0;
};

}  // namespace lockstep
