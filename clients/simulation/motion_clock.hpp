// Measures how long a job's epochs are in motion, from the outputs of the coordinator and the axes.
#pragma once

#include <algorithm>

#include "services/virtual/virtual_machine.hpp"

namespace lockstep {

class MotionClock final : public VirtualObserver {
public:
    void on_coordinator(std::size_t /*process*/, Tick /*now*/, const CoordinatorOutputs& out) override {
        for (const JobEvent& event : out.jobs) {
            if (event.kind == JobEvent::Kind::Begun) { begin_job(); }
            if (event.kind == JobEvent::Kind::EpochBegun) { begin_epoch(event); }
            if (event.kind == JobEvent::Kind::Ended) { last_ended_ = event; }
        }
    }
    void on_axis(MotorIndex /*axis*/, Tick /*now*/, const AxisOutputs& out, AxisNode& /*node*/) override {
        for (const ExecutedTrack& track : out.tracks) {
            if (track.epoch == 0 || track.epoch != epoch_) { continue; }  // 0: homing
            end_ = std::max(end_, track.start + total_ticks(track.pieces));
        }
    }

    /// The motion of the newest job so far: of each epoch, from its start to the end of its last run.
    Ticks motion() const { return before_ + (end_ - start_); }
    const std::optional<JobEvent>& last_ended() const { return last_ended_; }

private:
    void begin_job() {
        before_ = {};
        start_ = end_;
    }
    void begin_epoch(const JobEvent& event) {
        before_ = motion();
        epoch_ = event.epoch;
        start_ = end_ = event.start;
    }

    Ticks before_;  // in epochs before this one
    Epoch epoch_ = 0;
    Tick start_;
    Tick end_;
    std::optional<JobEvent> last_ended_;
};

}  // namespace lockstep
