// Counts how often each amount of ticks occurs, in a bounded number of classes that double in width.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "core/units.hpp"

namespace lockstep::analysis {

class TickHistogram {
public:
    /// Class 0 holds 0, and class k holds the amounts from 2^(k-1) to 2^k - 1. The last class also holds all larger
    /// ones.
    static constexpr std::size_t kClasses = 20;

    /// Adds the same amount `times` times, without its sign.
    void add(Ticks ticks, std::int64_t times = 1) {
        const auto amount = static_cast<std::uint64_t>(std::abs(ticks.value));
        counts_[std::min<std::size_t>(static_cast<std::size_t>(std::bit_width(amount)), kClasses - 1)] += times;
        largest_ = std::max(largest_, Ticks{static_cast<std::int64_t>(amount)});
        total_ += times;
    }
    void add(const TickHistogram& other) {
        for (std::size_t i = 0; i < kClasses; ++i) { counts_[i] += other.counts_[i]; }
        largest_ = std::max(largest_, other.largest_);
        total_ += other.total_;
    }

    bool empty() const { return total_ == 0; }
    std::int64_t total() const { return total_; }
    Ticks largest() const { return largest_; }
    /// The count of each class, and the largest amount in a class.
    const std::array<std::int64_t, kClasses>& counts() const { return counts_; }
    static Ticks most_in(std::size_t number) { return {(std::int64_t{1} << number) - 1}; }
    /// The amount that `percent` of all do not exceed. Exact if it is 0, else the end of its class or the largest
    /// amount.
    Ticks quantile(std::int64_t percent) const {
        std::int64_t seen = 0;
        for (std::size_t i = 0; i < kClasses; ++i) {
            seen += counts_[i];
            if (total_ > 0 && seen * 100 >= total_ * percent) { return std::min(most_in(i), largest_); }
        }
        return {};
    }

private:
    std::array<std::int64_t, kClasses> counts_{};
    std::int64_t total_ = 0;
    Ticks largest_;
};

}  // namespace lockstep::analysis
