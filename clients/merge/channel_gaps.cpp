#include "clients/merge/channel_gaps.hpp"

#include <algorithm>
#include <iterator>

namespace lockstep::merge {

void ChannelGaps::take(std::int64_t number, std::int64_t utime, std::int64_t lost) {
    least_lost_ = std::min(least_lost_.value_or(lost), lost);
    most_lost_ = std::max(most_lost_.value_or(lost), lost);
    const auto after = stretches_.upper_bound(number);
    const bool continues = after != stretches_.begin() && std::prev(after)->second.end == number;
    const auto stretch =
        continues ? std::prev(after) : stretches_.emplace_hint(after, number, Stretch{0, utime, utime});
    stretch->second.end = number + 1;
    stretch->second.last_us = utime;
    if (after == stretches_.end() || after->first != number + 1) { return; }
    stretch->second.end = after->second.end;
    stretch->second.last_us = after->second.last_us;
    stretches_.erase(after);
}

std::vector<MissingChanges> ChannelGaps::gaps() const {
    std::vector<MissingChanges> gaps;
    std::int64_t expected = 0;
    std::optional<std::int64_t> from_us;
    for (const auto& [first, stretch] : stretches_) {
        if (first > expected) { gaps.push_back({{}, first - expected, from_us, stretch.first_us}); }
        expected = stretch.end;
        from_us = stretch.last_us;
    }
    return gaps;
}

}  // namespace lockstep::merge
