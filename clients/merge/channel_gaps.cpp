#include "clients/merge/channel_gaps.hpp"

#include <algorithm>
#include <iterator>

namespace lockstep::merge {

void ChannelGaps::take(std::int64_t number, std::int64_t utime, std::int64_t lost) {
    least_lost_ = std::min(least_lost_.value_or(lost), lost);
    most_lost_ = std::max(most_lost_.value_or(lost), lost);
    const auto after = sequences_.upper_bound(number);
    const bool continues = after != sequences_.begin() && std::prev(after)->second.end == number;
    const auto sequence =
        continues ? std::prev(after) : sequences_.emplace_hint(after, number, Sequence{0, utime, utime});
    sequence->second.end = number + 1;
    sequence->second.last_us = utime;
    if (after == sequences_.end() || after->first != number + 1) { return; }
    sequence->second.end = after->second.end;
    sequence->second.last_us = after->second.last_us;
    sequences_.erase(after);
}

std::vector<MissingChanges> ChannelGaps::gaps() const {
    std::vector<MissingChanges> gaps;
    std::int64_t expected = 0;
    std::optional<std::int64_t> from_us;
    for (const auto& [first, sequence] : sequences_) {
        if (first > expected) { gaps.push_back({{}, first - expected, from_us, sequence.first_us}); }
        expected = sequence.end;
        from_us = sequence.last_us;
    }
    return gaps;
}

}  // namespace lockstep::merge
