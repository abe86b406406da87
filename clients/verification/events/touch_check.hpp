// Compares the recorded touches of probing moves with the recorded changes of the probes' inputs: a move ends at the
// earliest touch of its probe's inputs, and a move without a touch has none.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "clients/verification/findings.hpp"
#include "core/units.hpp"

namespace lockstep::verification {

/// A change of an input on record.
struct InputChange {
    std::int64_t utime = 0;  // when it was published
    std::string motor;       // whose device has the input
    int channel = 0;
    bool closed = false;
    Tick tick;  // of the input, machine time
    Ticks clock_error;
};

/// How a probing move ended by the record of its job. Ticks are machine time.
struct RecordedTouch {
    struct Input {
        std::string name;
        std::string motor;
        int channel = 0;
        Ticks debounce;  // by how much the input follows its pin
    };
    std::vector<Input> inputs;  // of the probe
    bool opens = false;         // they touch when they open
    Tick looked;                // before it the coordinator did not look at the inputs to begin the motion
    Tick begin;                 // of the motion
    Tick end;                   // the touch; without one, the end of the motion
    bool touched = false;
    std::string input;       // that touched first; empty: it is not on record
    std::int64_t utime = 0;  // when it was published
    std::string job;
};

class TouchCheck {
public:
    explicit TouchCheck(Findings& findings) : findings_(findings) {}

    void take(const InputChange& change);
    void take(RecordedTouch touch);

    /// Whether the log may lack changes of inputs at the motor's device.
    using MayLack = std::function<bool(const std::string& motor)>;
    /// Call once, at the end of the log.
    void finish(const MayLack& may_lack);

private:
    /// The log has the changes that were published with a touch at the latest after so long.
    static constexpr std::int64_t kPatience_us = 2'000'000;
    static constexpr std::size_t kMostChanges = 65'536;
    static constexpr std::size_t kMostOpen = 1000;

    /// A change of an input of a probe.
    struct Seen {
        const RecordedTouch::Input& input;
        Tick pin;  // when its pin changed
        Ticks within;
        bool is_awaited;  // the move ends at it: an input that had opened before does not end it by opening
    };
    std::vector<Seen> touches_in(const RecordedTouch& touch) const;
    void settle(std::int64_t utime);
    void compare(const RecordedTouch& touch);
    void differ(const RecordedTouch& touch, const std::string& text, std::optional<Tick> seen);

    Findings& findings_;
    std::multimap<Tick, InputChange> changes_;  // the newest
    std::deque<RecordedTouch> waiting_;         // for changes
    std::vector<RecordedTouch> unexplained_;    // by the changes of the log
};

}  // namespace lockstep::verification
