// A bounded queue of log lines. Any thread may add lines, one thread takes them, and no thread waits. If the queue is
// full, it drops the line and counts it.
//
// Each place has a number `turn`. It is `at` while the place is free for line number `at`, and `at + 1` while the place
// holds that line. A thread that adds a line claims a number, fills the place, and then publishes it. Source: Dmitry
// Vyukov's bounded MPMC queue.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace lockstep {

/// The text excludes the time and level, which the writer adds.
struct LogLine {
    static constexpr std::size_t kMaxBytes = 1000;  // the rest is cut off
    std::chrono::system_clock::time_point time;
    int level = 0;
    std::size_t bytes = 0;
    std::array<char, kMaxBytes> text;

    std::string_view view() const { return {text.data(), bytes}; }
};

template <std::size_t kPlaces>
class LineQueue {
public:
    LineQueue() {
        for (std::size_t i = 0; i < kPlaces; ++i) { places_[i].turn.store(i, std::memory_order_relaxed); }
    }

    /// Any thread may call it. Returns false if the queue is full.
    bool add(std::chrono::system_clock::time_point time, int level, std::string_view text) {
        std::size_t at = in_.load(std::memory_order_relaxed);
        for (;;) {
            Place& place = places_[at % kPlaces];
            const auto ahead = static_cast<std::ptrdiff_t>(place.turn.load(std::memory_order_acquire) - at);
            if (ahead < 0) {
                dropped_.fetch_add(1, std::memory_order_relaxed);
                return false;
            }
            if (ahead > 0) {
                at = in_.load(std::memory_order_relaxed);
            } else if (in_.compare_exchange_weak(at, at + 1, std::memory_order_relaxed)) {
                fill(place.line, time, level, text);
                place.turn.store(at + 1, std::memory_order_release);
                return true;
            }
        }
    }

    /// Only one thread may call it. Calls use(const LogLine&) for the oldest line. Returns false if there is none.
    template <typename Use>
    bool take(Use use) {
        const std::size_t at = out_.load(std::memory_order_relaxed);
        Place& place = places_[at % kPlaces];
        if (place.turn.load(std::memory_order_acquire) != at + 1) { return false; }
        use(place.line);
        place.turn.store(at + kPlaces, std::memory_order_release);
        out_.store(at + 1, std::memory_order_release);
        return true;
    }

    bool is_empty() const { return out_.load(std::memory_order_acquire) == in_.load(std::memory_order_relaxed); }
    /// Lines that were dropped.
    std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

private:
    struct Place {
        std::atomic<std::size_t> turn;
        LogLine line;
    };

    static void fill(LogLine& line, std::chrono::system_clock::time_point time, int level, std::string_view text) {
        line.time = time;
        line.level = level;
        line.bytes = std::min(text.size(), LogLine::kMaxBytes);
        std::copy_n(text.data(), line.bytes, line.text.data());
    }

    std::array<Place, kPlaces> places_;
    std::atomic<std::size_t> in_ = 0;
    std::atomic<std::size_t> out_ = 0;
    std::atomic<std::uint64_t> dropped_ = 0;
};

}  // namespace lockstep
