// Measures how late each axis's steps were, and the skew between axes. It is the stage between the figures of the axes
// and those of the jobs.
#pragma once

#include <string>
#include <vector>

#include "clients/analysis/measure/skew.hpp"
#include "clients/analysis/measure/sorted_log.hpp"

namespace lockstep::analysis {

class LateMeter final : public SortedListener {
public:
    /// `next` receives everything that this object receives, and the lateness of steps.
    explicit LateMeter(SortedListener& next) : next_(next) {}
    LateMeter(const LateMeter&) = delete;
    LateMeter& operator=(const LateMeter&) = delete;

    void on_axis(const std::string& name) override;
    void on_measured(std::size_t lane, const SharedSteps& steps) override;
    void on_position(const axis_position_t& message) override {
        skew_.pass(message.axis, Tick{message.tick});
        next_.on_position(message);
    }
    void on_run(std::size_t lane, const Run& run) override;
    void on_job(const RecordedJob& message, LogPlace place) override { next_.on_job(message, place); }
    void on_event(const program_event_t& message, const ProgramEvent& event) override {
        next_.on_event(message, event);
    }
    void on_channel(const channel_event_t& message) override { next_.on_channel(message); }
    void on_damage(LogPlace place, const std::string& what) override { next_.on_damage(place, what); }

    /// Call once, at the end of the log. Returns the pairs of axes that ran frames together.
    std::vector<PairSkew> finish() { return skew_.finish(); }

private:
    SortedListener& next_;
    std::vector<std::string> axes_;  // by lane
    SkewMeter skew_{[this](const std::string& axis, const SharedLate& steps) { next_.on_late(axis, steps); }};
};

}  // namespace lockstep::analysis
