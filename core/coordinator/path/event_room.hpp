// Whether the changes of outputs in a body and its tail fit into a frame.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/coordinator/path/event_queue.hpp"
#include "core/coordinator/path/touched_outputs.hpp"
#include "core/machine.hpp"
#include "core/protocol/frame_room.hpp"

namespace lockstep {

class EventRoom {
public:
    explicit EventRoom(const MachineConfig& machine) : touched_(machine.outputs), room_(output_room(machine.timing)) {}

    /// No event changes an output.
    bool none() const { return touched_.none(); }
    /// `body`, `tail`: the moves that begin there. `is_last`: the path ends in the body.
    bool fits(const EventQueue& events, std::span<const MoveBegin> body, std::span<const MoveBegin> tail,
              bool is_last) {
        events.list_ahead(body, tail, is_last ? std::optional(Ticks{1}) : std::nullopt, in_body_, in_tail_);
        return changes(in_body_) <= room_.body && changes(in_tail_) <= room_.tail;
    }

private:
    std::size_t changes(std::span<const FrameEvent> events) {
        std::size_t count = touched_.besides();
        for (std::size_t k = 0; k < events.size(); ++k) {
            touched_.add(events[k].event.event);
            const bool is_last_of_tick = k + 1 == events.size() || events[k + 1].at != events[k].at;
            if (!is_last_of_tick) { continue; }
            count += touched_.changes();
            touched_.clear();
        }
        return count;
    }

    TouchedOutputs touched_;
    OutputRoom room_;
    std::vector<FrameEvent> in_body_;
    std::vector<FrameEvent> in_tail_;
};

}  // namespace lockstep
