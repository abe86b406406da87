// Hands the newest value from one thread to another. Neither ever waits for the other, because each has a place of its
// own: they exchange their places with a third one (a triple buffer).
#pragma once

#include <array>
#include <atomic>
#include <utility>

namespace lockstep {

template <typename T>
class NewestValue {
public:
    /// For the thread that has the values. Replaces a value that was not taken.
    void put(T value) {
        places_[written_] = std::move(value);
        written_ = between_.exchange(written_ | kIsNew, std::memory_order_acq_rel) & kPlace;
    }

    /// For the thread that uses them. Null if no value came since the last call. The result is valid until the next
    /// call.
    const T* take() {
        if ((between_.load(std::memory_order_relaxed) & kIsNew) == 0) { return nullptr; }
        read_ = between_.exchange(read_, std::memory_order_acq_rel) & kPlace;
        return &places_[read_];
    }

private:
    static constexpr unsigned kPlace = 3;
    static constexpr unsigned kIsNew = 4;

    std::array<T, 3> places_{};
    unsigned written_ = 0;              // used only by put()
    std::atomic<unsigned> between_{1};  // the third place, and whether its value is new
    unsigned read_ = 2;                 // used only by take()
};

}  // namespace lockstep
