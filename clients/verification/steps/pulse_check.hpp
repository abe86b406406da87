// The pulses that a device makes at places, as the steps of its runs make them: the device notes when it was told the
// places, and when the last pulse was made or its run ended.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/hardware/output_change.hpp"
#include "services/record/reading/run.hpp"

namespace lockstep::verification {

class PulseCheck {
public:
    /// Messages or runs are missing. Nothing is known until the next motion begins.
    void lose() {
        is_known_ = false;
        left_.reset();
    }

    /// The body or tail that the device ran next, whole. `changes`: those of its frame, in order, with the ticks at
    /// which the device made them. `is_last`: the motion ends with it. Returns the events that it must have noted;
    /// nullopt if that is not known.
    struct Part {
        const analysis::Run& run;
        std::vector<OutputChange> changes;
        bool is_last = false;
    };
    std::optional<std::vector<ChannelEvent>> events_of(const Part& part);
    /// How many pulses of the newest places were not made when the motion ended. nullopt: it is not known, or the
    /// device was told no places in this motion.
    const std::optional<std::uint32_t>& left() const { return left_; }

private:
    void begin(const ComparePosition& places, Tick tick, std::int64_t count, std::vector<ChannelEvent>& events);
    void end(Tick tick, std::int64_t count, std::vector<ChannelEvent>& events);
    void arrive(Tick tick, std::int64_t count, std::vector<ChannelEvent>& events);

    ComparePosition places_;  // that are left, by the device's count
    bool is_known_ = false;
    std::optional<std::uint32_t> left_;
};

}  // namespace lockstep::verification
