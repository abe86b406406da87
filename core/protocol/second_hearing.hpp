// What only a message says is believed when it is said in a second slot: one message may be damaged.
#pragma once

#include <array>
#include <cstddef>

#include "core/protocol/messages.hpp"

namespace lockstep {

/// `kSpeakers`: how many different things may be said in turn, slot by slot, and each be heard again.
template <typename T, std::size_t kSpeakers = 1>
class SecondHearing {
public:
    /// Whether the same was heard in an earlier slot, among the last few different things.
    bool again(const T& what, Slot stamp) {
        for (Rumour& rumour : rumours_) {
            if (rumour.what != what) { continue; }
            const bool later = stamp > rumour.stamp;
            rumour.stamp = stamp;
            return later;
        }
        rumours_[next_] = {what, stamp};
        next_ = (next_ + 1) % kSpeakers;
        return false;
    }

private:
    struct Rumour {
        T what{};
        Slot stamp = 0;
    };
    std::array<Rumour, kSpeakers> rumours_{};
    std::size_t next_ = 0;
};

/// Of who owns the machine. Axes that follow one term, or another, and those who claim one speak all at once; and a few
/// words may be damaged.
using TermHearing = SecondHearing<Term, 8>;

/// The highest term that was heard in two slots.
class HighestTerm {
public:
    void hear(const Term& term, Slot stamp) {
        if (term > highest_ && rumours_.again(term, stamp)) { highest_ = term; }
    }
    const Term& value() const { return highest_; }

private:
    Term highest_;
    TermHearing rumours_;
};

}  // namespace lockstep
