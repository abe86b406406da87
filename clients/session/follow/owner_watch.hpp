// What a client knows of the machine's owner from its states, and whether the client was itself stopped since the
// newest one. Pure: the caller passes the messages and the time.
#pragma once

#include <chrono>
#include <optional>

#include "core/protocol/messages.hpp"
#include "services/runtime/running_clock.hpp"

namespace lockstep {

template <typename State>
struct Received {
    State state;
    std::chrono::nanoseconds time;  // CLOCK_MONOTONIC of this host
};

/// The owner as a client sees it when it decides whether to send.
struct OwnerSight {
    Term owner;
    bool is_silent = false;
    bool is_current = true;  // false: this client was itself stopped and has not received a new state since
};

class OwnerWatch {
public:
    using Time = std::chrono::nanoseconds;
    /// After this time without a state of the owner, the state of a coordinator with a lower term counts.
    static constexpr std::chrono::seconds kOwnerSilence{1};
    /// After a stall, states that wait in this host's buffers are old. They are all read within this time.
    static constexpr std::chrono::milliseconds kOldStates{100};

    /// `longest_silence`: an owner without a state for longer is silent.
    explicit OwnerWatch(Time longest_silence) : longest_silence_(longest_silence) {}

    /// A look for messages from `begin` to `end`, which was to last `at_most`.
    void look(Time begin, Time end, Time at_most) { clock_.look(begin, end, at_most); }
    /// A state that came in the last look. Not for the states of a standby.
    void take(const MachineState& state, Time now);

    /// The owner's newest state; nullopt before the first.
    const std::optional<Received<MachineState>>& state() const { return state_; }
    /// The time for which this client has looked for messages. Time in which it was itself stopped does not count.
    Time running_time() const { return clock_.passed(); }
    OwnerSight sight() const;
    /// Returns once how long this client was stopped, as soon as it has received a new state; else nullopt.
    std::optional<Time> take_stall();

private:
    bool is_current() const;

    Time longest_silence_;
    RunningClock clock_;
    std::optional<Received<MachineState>> state_;
    Time heard_{};  // running_time() at the newest state
};

}  // namespace lockstep
