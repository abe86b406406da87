// The events of frames that were made, until the motion has reached their places.
#pragma once

#include <span>
#include <vector>

#include "core/coordinator/path/event_queue.hpp"
#include "core/path/sliding_vector.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

class DueEvents {
public:
    struct Happened {
        Tick tick;  // of the motion
        PathEvent event;
    };

    /// An epoch begins.
    void clear() { due_.clear(); }
    /// The events with places in a frame, in order.
    void add(const Frame& frame, std::span<const FrameEvent> events) {
        for (const FrameEvent& event : events) {
            due_.push_back({frame.number, {frame.start + event.at, event.event}});
        }
    }
    /// Returns the events that the motion has reached by `now`, each once. `begun`: the newest frame that an axis has
    /// begun. Valid until the next call.
    std::span<const Happened> take(Tick now, FrameNumber begun) {
        happened_.clear();
        for (; !due_.empty() && due_.front().frame <= begun && due_.front().event.tick <= now; due_.pop_front()) {
            happened_.push_back(due_.front().event);
        }
        return happened_;
    }

private:
    struct Due {
        FrameNumber frame = 0;
        Happened event;
    };
    SlidingVector<Due> due_;
    std::vector<Happened> happened_;
};

}  // namespace lockstep
