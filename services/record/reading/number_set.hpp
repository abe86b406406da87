// A set of the numbers 0, 1, 2, ... It is stored as ranges, because nearly all numbers are received, nearly in order.
#pragma once

#include <cstdint>
#include <iterator>
#include <map>
#include <vector>

namespace lockstep::analysis {

/// The numbers from `from` up to but not including `end`.
struct Numbers {
    std::int64_t from = 0;
    std::int64_t end = 0;
    bool operator==(const Numbers&) const = default;
};

class NumberSet {
public:
    /// Returns false if the set already contains the number.
    bool add(std::int64_t number) {
        auto after = ends_.upper_bound(number);
        const bool follows = after != ends_.begin() && std::prev(after)->second >= number;
        if (follows && std::prev(after)->second > number) { return false; }
        const auto stretch = follows ? std::prev(after) : ends_.emplace_hint(after, number, number);
        stretch->second = number + 1;
        if (after != ends_.end() && after->first == number + 1) {
            stretch->second = after->second;
            ends_.erase(after);
        }
        return true;
    }

    /// One more than the highest number; 0 if the set is empty.
    std::int64_t end() const { return ends_.empty() ? 0 : ends_.rbegin()->second; }

    /// How many numbers are missing between the lowest and the highest.
    std::int64_t missing_within() const {
        if (ends_.empty()) { return 0; }
        std::int64_t missing = ends_.rbegin()->second - ends_.begin()->first;
        for (const auto& [from, end] : ends_) { missing -= end - from; }
        return missing;
    }

    /// The missing numbers between 0 and the highest.
    std::vector<Numbers> gaps() const {
        std::vector<Numbers> out;
        std::int64_t expected = 0;
        for (const auto& [from, end] : ends_) {
            if (from > expected) { out.push_back({expected, from}); }
            expected = end;
        }
        return out;
    }

private:
    std::map<std::int64_t, std::int64_t> ends_;  // the end of each range, by its beginning
};

}  // namespace lockstep::analysis
