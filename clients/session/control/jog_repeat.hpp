// Decides when a jog's command is sent again. Pure: the caller passes the time.
#pragma once

#include <algorithm>
#include <chrono>

namespace lockstep {

class JogRepeat {
public:
    using Time = std::chrono::nanoseconds;
    static constexpr std::chrono::milliseconds kPeriod{5};

    void note_sent(Time now) { sent_ = now; }
    /// `is_needed`: true during a press, and after a release until it is answered.
    bool is_due(bool is_needed, Time now) const { return is_needed && now >= sent_ + kPeriod; }
    /// Returns the time until which nothing is due.
    Time wake(bool is_needed, Time until) const { return is_needed ? std::min(until, sent_ + kPeriod) : until; }

private:
    Time sent_{};
};

}  // namespace lockstep
