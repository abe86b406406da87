// The frames of an epoch that have not begun, and the vetoes: which frames are sent again, and which no axis may run.
#pragma once

#include <optional>
#include <span>

#include "core/coordinator/axes/axis_view.hpp"
#include "core/protocol/messages.hpp"
#include "core/protocol/rules.hpp"
#include "core/reused_queue.hpp"
#include "core/reused_vector.hpp"

namespace lockstep {

class FramesInFlight {
public:
    FramesInFlight(const ProtocolTiming& timing, Ticks slot) : timing_(timing), slot_(slot) {}

    /// An epoch begins.
    void clear();
    /// Adds what `make(old)` returns as the newest frame. `old` is an earlier frame, whose memory it may take.
    template <typename Make>
    Frame& add(Make&& make) {
        return frames_.renew_back(make);
    }
    /// Receives the axes' vetoes. Returns the newest frame that every axis holds; `newest`: of those made.
    FrameNumber receive(Epoch epoch, FrameNumber newest, std::span<const AxisView> axes);
    /// Adds to `frames` those that an axis lacks and may still run. `held`: the newest one that every axis holds.
    void repeat(Slot now, FrameNumber held, ReusedVector<Frame>& frames);
    /// Vetoes the lowest frame that no axis can have armed yet, by the state published in slot `next`; `newest`: of
    /// those made.
    void stop(Slot next, FrameNumber newest);

    bool is_vetoed_by_axis() const { return received_veto_.has_value(); }
    /// The lowest veto of the coordinator's own and the received ones. Every process repeats the lowest that it knows.
    std::optional<FrameNumber> veto() const { return rules::merge(veto_, received_veto_); }

private:
    ProtocolTiming timing_;
    Ticks slot_;
    ReusedQueue<Frame> frames_;
    std::optional<FrameNumber> veto_;           // the coordinator's own
    std::optional<FrameNumber> received_veto_;  // the lowest of the axes'
};

}  // namespace lockstep
