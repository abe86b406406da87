// The time for which a client has looked for messages. Its own stalls are left out, so a client that was stopped looks
// again before it calls a coordinator silent. Deadlines of a session count in this time. Pure: the caller passes the
// time.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

namespace lockstep {

class RunningClock {
public:
    using Time = std::chrono::nanoseconds;
    static constexpr std::chrono::milliseconds kLateWake{
        500};                                               // a wait that lasts longer than asked by more is a stall
    static constexpr std::chrono::milliseconds kWork{100};  // of the time between two looks, so much counts
    static constexpr std::chrono::seconds kLeastStall{2};   // shorter stalls are not worth a report

    /// A look for messages from `begin` to `end`, which was to last `at_most`.
    void look(Time begin, Time end, Time at_most) {
        const Time between = looked_ ? begin - *looked_ : Time{};
        const Time lasted = end - begin;
        const Time counted = std::min<Time>(lasted, at_most + kLateWake);
        passed_ += std::clamp<Time>(between, Time{}, kWork) + counted;
        if (lasted > counted || between > kLateWake) { resumed_ = end; }
        if (lasted - counted >= kLeastStall) { stall_ = {lasted - counted, end}; }
        looked_ = end;
    }
    Time passed() const { return passed_; }

    /// The end of the first look after the latest stall, also a short one; nullopt if there was none.
    const std::optional<Time>& resumed() const { return resumed_; }

    struct Stall {
        Time lasted{};
        Time end{};
    };
    /// The latest stall that forget_stall() has not removed.
    const std::optional<Stall>& stall() const { return stall_; }
    void forget_stall() { stall_.reset(); }

private:
    Time passed_{};
    std::optional<Time> looked_;
    std::optional<Time> resumed_;
    std::optional<Stall> stall_;
};

}  // namespace lockstep
