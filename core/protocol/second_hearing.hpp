// What only a message says is believed when it is said in a second slot: one message may be damaged.
#pragma once

#include "core/protocol/messages.hpp"

namespace lockstep {

template <typename T>
class SecondHearing {
public:
    /// Whether the last one heard said the same, in an earlier slot.
    bool again(const T& what, Slot stamp) {
        const bool same = what == last_ && stamp > stamp_;
        last_ = what;
        stamp_ = stamp;
        return same;
    }

private:
    T last_{};
    Slot stamp_ = 0;
};

/// The highest term that was heard in two slots.
class HighestTerm {
public:
    void hear(const Term& term, Slot stamp) {
        if (term > highest_ && rumour_.again(term, stamp)) { highest_ = term; }
    }
    const Term& value() const { return highest_; }

private:
    Term highest_;
    SecondHearing<Term> rumour_;
};

}  // namespace lockstep
