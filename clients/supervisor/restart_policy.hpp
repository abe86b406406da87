// Decides when a process that ended unexpectedly is started again: soon at first, then later. Pure.
//
// A process that ends with an exit code has a reason that may last, so it is given up eventually. A process that a
// signal ended has met a temporary fault: damaged packets, too little memory, a library call that never returned. It
// is started again each time.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <deque>
#include <optional>

namespace lockstep {

inline constexpr std::size_t kMaxRestarts = 5;  // after exits, within kRestartWindow
inline constexpr std::chrono::seconds kRestartWindow{60};
inline constexpr std::chrono::milliseconds kFirstRestartDelay{
    200};  // doubles with each restart in the window, up to 3.2 s

enum class ProcessEnd { Exit, Signal };

class RestartPolicy {
public:
    /// Call it when the process has ended. Returns the delay before it is started again, or nullopt to give up.
    std::optional<std::chrono::milliseconds> after_end(std::chrono::nanoseconds now, ProcessEnd how) {
        while (!ends_.empty() && now - ends_.front().time > kRestartWindow) { ends_.pop_front(); }
        const auto is_exit = [](const End& end) { return end.how == ProcessEnd::Exit; };
        const bool is_full = ends_.size() >= kMaxRestarts;
        if (is_full && how == ProcessEnd::Exit && std::ranges::all_of(ends_, is_exit)) { return std::nullopt; }
        if (is_full) { ends_.pop_front(); }
        ends_.push_back({now, how});
        return kFirstRestartDelay * (1 << (ends_.size() - 1));
    }

private:
    struct End {
        std::chrono::nanoseconds time;
        ProcessEnd how;
    };
    std::deque<End> ends_;
};

}  // namespace lockstep
