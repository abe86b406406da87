// A buffer of steps in 64 bits each, in memory of the caller, for processes that move many axes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/step/segment.hpp"

namespace lockstep {

/// The steps of one axis, in order. Never allocates. Its capacity is kSlack steps less than the room, because vectors
/// are written whole. A packed step is twice the tick, plus 1 if it is backward. Ticks are within +-2^62.
class EdgeBuffer {
public:
    static constexpr std::size_t kSlack = 32;  // lanes of the longest vectors of any processor

    EdgeBuffer() = default;
    explicit EdgeBuffer(std::span<std::int64_t> room)
        : room_(room), capacity_(room.size() > kSlack ? room.size() - kSlack : 0) {}

    std::size_t size() const { return size_; }
    void clear() { size_ = 0; }
    StepEdge operator[](std::size_t i) const {
        return {Tick{room_[i] >> 1}, static_cast<std::int8_t>((room_[i] & 1) != 0 ? -1 : 1)};
    }

    /// The unfilled room without the slack. A writer fills it from the front and then calls filled().
    std::span<std::int64_t> free() const { return room_.subspan(size_, capacity_ - size_); }
    void filled(std::size_t steps) { size_ += steps; }

    static constexpr std::int64_t pack(Tick tick, bool backward) { return tick.value * 2 + (backward ? 1 : 0); }

    /// The room for the steps of this many ticks in any motion: at most one step every second tick, and one more for
    /// each change of direction or piece.
    static constexpr std::size_t room_for(Ticks ticks, std::size_t turns) {
        return static_cast<std::size_t>(ticks.value) / 2 + 1 + turns + kSlack;
    }

private:
    std::span<std::int64_t> room_;
    std::size_t capacity_ = 0;
    std::size_t size_ = 0;
};

}  // namespace lockstep
