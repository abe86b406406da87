// The actions that the server's thread gives the machine's thread.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <utility>

namespace lockstep::web {

class ActionQueue {
public:
    using Action = std::function<void()>;
    static constexpr std::size_t kMostActions = 64;  // that wait
    static constexpr std::size_t kMostStops = 16;    // that may wait in addition

    /// Returns false if too many wait already. `is_stop`: it has a place even if too many others wait.
    bool add(Action action, bool is_stop) {
        const std::lock_guard lock(mutex_);
        if (actions_.size() >= kMostActions + (is_stop ? kMostStops : 0)) { return false; }
        actions_.push_back(std::move(action));
        return true;
    }
    /// All that wait, in order.
    std::deque<Action> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(actions_, {});
    }

private:
    std::mutex mutex_;
    std::deque<Action> actions_;
};

}  // namespace lockstep::web
