// The processes of an axis, in the order of their first messages. A process is identified by its number.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lockstep::verification {

class ProcessOrder {
public:
    /// The process has published.
    void take(std::int64_t incarnation) { (void)birth_of(incarnation); }
    /// There must be a process.
    std::int64_t first() const { return incarnations_.front(); }
    bool is_first(std::int64_t incarnation) { return birth_of(incarnation) == 0; }
    bool is_older(std::int64_t one, std::int64_t other) { return birth_of(one) < birth_of(other); }
    /// Whether a second process has published.
    bool has_changed() const { return incarnations_.size() > 1; }

private:
    std::size_t birth_of(std::int64_t incarnation) {
        const auto known = std::ranges::find(incarnations_, incarnation);
        const auto birth = static_cast<std::size_t>(known - incarnations_.begin());
        if (known == incarnations_.end()) { incarnations_.push_back(incarnation); }
        return birth;
    }

    std::vector<std::int64_t> incarnations_;
};

}  // namespace lockstep::verification
