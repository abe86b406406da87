// A value is accepted only after two slots carried it: one message may be damaged.
#pragma once

#include <array>
#include <cstddef>

#include "core/protocol/messages.hpp"

namespace lockstep {

/// Up to `kValues` different values can alternate from slot to slot, and each is still recognised.
template <typename T, std::size_t kValues = 1>
class RepeatedValue {
public:
    /// Whether an earlier slot carried the same value; only the newest kValues are compared.
    bool again(const T& what, Slot stamp) {
        for (Candidate& candidate : candidates_) {
            if (candidate.what != what) { continue; }
            const bool later = stamp > candidate.stamp;
            candidate.stamp = stamp;
            return later;
        }
        candidates_[next_] = {what, stamp};
        next_ = (next_ + 1) % kValues;
        return false;
    }

private:
    struct Candidate {
        T what{};
        Slot stamp = 0;
    };
    std::array<Candidate, kValues> candidates_{};
    std::size_t next_ = 0;
};

/// For terms of owners. Axes that follow different terms and coordinators that claim one may publish at the same time,
/// and a few messages may be damaged.
using RepeatedTerm = RepeatedValue<Term, 8>;

/// The highest term that two slots carried.
class HighestTerm {
public:
    void receive(const Term& term, Slot stamp) {
        if (term > highest_ && candidates_.again(term, stamp)) { highest_ = term; }
    }
    const Term& value() const { return highest_; }

private:
    Term highest_;
    RepeatedTerm candidates_;
};

}  // namespace lockstep
