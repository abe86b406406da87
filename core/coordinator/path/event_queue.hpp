// The events of a leg, in order, until the motion reaches their places.
//
// An event belongs between the moves of its program. Its place is where the first move after it begins, or the leg's
// end. So an event is due when a move of a later block begins.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/path/frame_planner.hpp"
#include "core/path/sliding_vector.hpp"
#include "core/program.hpp"
#include "core/units.hpp"

namespace lockstep {

struct PathEvent {
    std::uint32_t block = 0;
    std::optional<std::int32_t> line;
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
    /// Another leg begins.
    void clear() {
        events_.clear();
        next_ = 0;
        from_ = resumed_ = 0;
    }
    /// Called in the order of the program.
    void add(const PathEvent& event) {
        if (event.block < from_) { return; }
        events_.push_back(event);
        if (event.block < resumed_) { next_ = events_.size(); }
    }
    /// The events before this block have happened and are not kept.
    void begin_from(std::uint32_t block) {
        from_ = block;
        while (!events_.empty() && events_.front().block < block) { events_.pop_front(); }
        next_ = 0;
    }
    /// The motion continues in this block. The events before it are not due again.
    void resume(std::uint32_t block) {
        resumed_ = block;
        next_ = 0;
        while (next_ < events_.size() && events_[next_].block < block) { ++next_; }
    }
    /// Call it when a frame was made. Sets `due` to the events with places in this frame. `begins`: the moves that
    /// begin in it.
    void take_due(const PathFrame& frame, std::span<const MoveBegin> begins, std::vector<FrameEvent>& due) {
        next_ = list_due(next_, begins, frame.last ? std::optional(frame.ticks) : std::nullopt, due);
    }
    /// Sets `due` to the events with places in the tail of the frame whose events were taken last. They stay due.
    void list_in_tail(std::span<const MoveBegin> begins, std::vector<FrameEvent>& due) const {
        (void)list_due(next_, begins, std::nullopt, due);
    }
    /// The same before the frame is made. `end`: of the path, if it ends in the frame.
    void list_ahead(std::span<const MoveBegin> body, std::span<const MoveBegin> tail, std::optional<Ticks> end,
                    std::vector<FrameEvent>& in_body, std::vector<FrameEvent>& in_tail) const {
        (void)list_due(list_due(next_, body, end, in_body), tail, std::nullopt, in_tail);
    }
    /// The kept events before a block.
    std::span<const PathEvent> before(std::uint32_t block) const {
        std::size_t count = 0;
        while (count < events_.size() && events_[count].block < block) { ++count; }
        return {events_.begin(), count};
    }
    void forget_before(std::uint32_t block) {
        for (; !events_.empty() && events_.front().block < block && next_ > 0; --next_) { events_.pop_front(); }
    }

private:
    static constexpr std::uint32_t kAll = std::numeric_limits<std::uint32_t>::max();

    /// Returns the first event that is not due.
    std::size_t list_due(std::size_t next, std::span<const MoveBegin> begins, std::optional<Ticks> end,
                         std::vector<FrameEvent>& due) const {
        due.clear();
        const auto list_before = [&](std::uint32_t block, Ticks at) {
            for (; next < events_.size() && events_[next].block < block; ++next) { due.push_back({at, events_[next]}); }
        };
        for (const MoveBegin& begin : begins) { list_before(begin.block, Ticks{std::llround(begin.at)}); }
        if (end) { list_before(kAll, *end); }
        return next;
    }

    SlidingVector<PathEvent> events_;
    std::size_t next_ = 0;  // the first event that was not due yet
    std::uint32_t from_ = 0;
    std::uint32_t resumed_ = 0;
};

}  // namespace lockstep
