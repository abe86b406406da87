// The stop that a sender's lines end with, from its command until the machine rests.
#pragma once

#include <chrono>
#include <optional>

#include "clients/grbl/lines/machine_port.hpp"

namespace lockstep::grbl {

class LineStop {
public:
    static constexpr std::chrono::seconds kPatience{20};

    explicit LineStop(MachinePort& port) : port_(port) {}

    void begin(std::chrono::nanoseconds now) {
        grbl::begin(port_, stop_, CommandKind::Stop);
        since_ = now;
    }
    /// Call in each loop. `rests`: the machine has no job, and every axis is at rest. `state_age`: after this time the
    /// newest state shows the effect of an answered command.
    void pass(bool rests, std::chrono::nanoseconds state_age, std::chrono::nanoseconds now) {
        if (stop_) {
            follow(port_, stop_);
            since_ = now;
        }
        if (stop_ || !since_) { return; }
        if ((rests && now - *since_ > state_age) || now - *since_ > kPatience) { since_.reset(); }
    }
    bool is_in_progress() const { return since_.has_value(); }

private:
    MachinePort& port_;
    std::optional<CommandTracker> stop_;
    std::optional<std::chrono::nanoseconds> since_;  // since the answer, as soon as that came
};

}  // namespace lockstep::grbl
