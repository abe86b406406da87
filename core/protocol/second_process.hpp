// Proves that a second process publishes in the same role as this one.
//
// Of two processes with the same role one must end. A single state proves nothing, because old states may be sent
// again, and states may be damaged. A process counts as running after kStatesThatProve current states in a row.
#pragma once

#include "core/protocol/rules.hpp"

namespace lockstep {

class SecondProcess {
public:
    static constexpr int kStatesThatProve = 20;

    explicit SecondProcess(const ProtocolTiming& timing) : silence_(rules::silence_slots(timing)) {}

    /// Takes a state that another process stamped, received now. Returns true if that process is proved to run.
    bool proves(Identity process, Slot stamp, Slot now) {
        const bool is_current = stamp <= now + rules::kHopSlots && now - stamp <= silence_;
        if (!is_current) { return is_proved(); }
        if (process != process_ || stamp - last_ > silence_) { count_ = 0; }
        if (count_ > 0 && stamp <= last_) { return is_proved(); }
        process_ = process;
        last_ = stamp;
        ++count_;
        return is_proved();
    }

private:
    bool is_proved() const { return count_ >= kStatesThatProve; }

    Slot silence_;
    Identity process_ = 0;
    Slot last_ = 0;
    int count_ = 0;
};

}  // namespace lockstep
