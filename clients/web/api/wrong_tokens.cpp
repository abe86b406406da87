#include "clients/web/api/wrong_tokens.hpp"

#include <algorithm>

namespace lockstep::web {

bool WrongTokens::is_locked(const std::string& address, std::chrono::nanoseconds now) const {
    const auto found = times_.find(address);
    return found != times_.end() && found->second.size() >= kMost && now - found->second.front() <= kWithin;
}

void WrongTokens::note(const std::string& address, std::chrono::nanoseconds now) {
    if (times_.size() >= kMostAddresses && !times_.contains(address)) { forget_one(); }
    auto& times = times_[address];
    times.push_back(now);
    if (times.size() > kMost) { times.pop_front(); }
}

void WrongTokens::forget_one() {
    const auto last = [](const auto& entry) { return entry.second.back(); };
    times_.erase(std::ranges::min_element(times_, {}, last));
}

}  // namespace lockstep::web
