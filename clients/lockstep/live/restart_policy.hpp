// How often a process that ended unasked is started again: soon at first, then later, and not for ever. Pure.
#pragma once

#include <chrono>
#include <deque>
#include <optional>

namespace lockstep {

inline constexpr std::size_t kMaxRestarts = 5;  // within kRestartWindow
inline constexpr std::chrono::seconds kRestartWindow{60};
inline constexpr std::chrono::milliseconds kFirstRestartDelay{200};  // doubles with each restart in the window

class RestartPolicy {
public:
    /// The process ended at `now`: how long to wait before it is started again. Nothing: give up.
    std::optional<std::chrono::milliseconds> after_end(std::chrono::nanoseconds now) {
        while (!ends_.empty() && now - ends_.front() > kRestartWindow) { ends_.pop_front(); }
        if (ends_.size() >= kMaxRestarts) { return std::nullopt; }
        ends_.push_back(now);
        return kFirstRestartDelay * (1 << (ends_.size() - 1));
    }

private:
    std::deque<std::chrono::nanoseconds> ends_;
};

}  // namespace lockstep
