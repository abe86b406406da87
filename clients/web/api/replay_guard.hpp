// Remembers which idempotency keys were used recently. Pure.
#pragma once

#include <chrono>
#include <deque>
#include <set>
#include <string>

namespace lockstep::web {

class ReplayGuard {
public:
    static constexpr std::chrono::minutes kKept{10};
    static constexpr std::size_t kMostKeys = 10'000;  // the oldest is dropped first

    /// Returns false if the key was used within kKept.
    bool use(const std::string& key, std::chrono::nanoseconds now) {
        while (!order_.empty() && (now - order_.front().second > kKept || order_.size() >= kMostKeys)) {
            keys_.erase(order_.front().first);
            order_.pop_front();
        }
        if (!keys_.insert(key).second) { return false; }
        order_.emplace_back(key, now);
        return true;
    }

private:
    std::set<std::string> keys_;
    std::deque<std::pair<std::string, std::chrono::nanoseconds>> order_;
};

}  // namespace lockstep::web
