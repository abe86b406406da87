// The events of a leg, in order, until the motion comes to their places.
//
// An event belongs between the moves of its program: its place is where the first move behind it begins, or the leg's
// end. So an event is due when a move of a later block begins.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <vector>

#include "core/program.hpp"
#include "core/units.hpp"

namespace lockstep {

struct PathEvent {
    std::uint32_t block = 0;
    std::int32_t line = 0;
    ProgramEvent event;
    bool operator==(const PathEvent&) const = default;
};

/// An event that is due in a frame.
struct FrameEvent {
    Ticks at;  // from the frame's begin
    PathEvent event;
};

class EventQueue {
public:
    static constexpr std::uint32_t kAll = std::numeric_limits<std::uint32_t>::max();

    /// In the order of the program.
    void add(const PathEvent& event) {
        if (event.block >= from_) { events_.push_back(event); }
    }
    /// Those before this block have happened: they are not kept.
    void begin_from(std::uint32_t block) { from_ = block; }
    /// The motion goes on in this block: the events before it are not due again.
    void resume(std::uint32_t block) {
        next_ = 0;
        while (next_ < events_.size() && events_[next_].block < block) { ++next_; }
    }
    /// A move of this block begins: the events before it are due. They are appended to `due`.
    void pass(std::uint32_t block, Ticks at, std::vector<FrameEvent>& due) {
        for (; next_ < events_.size() && events_[next_].block < block; ++next_) { due.push_back({at, events_[next_]}); }
    }
    /// Those that are kept, before a block.
    std::vector<PathEvent> before(std::uint32_t block) const {
        std::vector<PathEvent> events;
        for (const PathEvent& event : events_) {
            if (event.block < block) { events.push_back(event); }
        }
        return events;
    }
    void forget_before(std::uint32_t block) {
        for (; !events_.empty() && events_.front().block < block && next_ > 0; --next_) { events_.pop_front(); }
    }

private:
    std::deque<PathEvent> events_;
    std::size_t next_ = 0;
    std::uint32_t from_ = 0;
};

}  // namespace lockstep
