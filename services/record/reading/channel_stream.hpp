// The changes of one device's inputs and outputs in the order in which its process published them, though messages of a
// log may be shuffled, repeated or missing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

namespace lockstep::analysis {

/// `Change` has the members incarnation and sequence of channel_event_t.
template <typename Change>
class ChannelStream {
public:
    static constexpr std::size_t kMostEarly = 64;  // changes that wait for one with a lower number

    enum class Before : std::uint8_t { Nothing, Gap, OtherProcess };

    /// Calls visit(change, before) for each change when its turn comes. `before`: what the log lacks before it. Copies
    /// are left out.
    template <typename Visit>
    void take(const Change& change, Visit visit) {
        if (process_ != change.incarnation) {
            release(0, visit);
            is_first_ = true;
            next_ = 0;
            process_ = change.incarnation;
        }
        if (change.sequence < next_) { return; }
        early_.emplace(change.sequence, change);
        release(kMostEarly, visit);
    }
    /// Call once, at the end of the log.
    template <typename Visit>
    void finish(Visit visit) {
        release(0, visit);
    }

private:
    template <typename Visit>
    void release(std::size_t most_early, Visit visit) {
        while (!early_.empty()) {
            const auto first = early_.begin();
            const bool is_next = first->first == next_;
            if (!is_next && early_.size() <= most_early) { return; }
            const Before before = is_first_ ? Before::OtherProcess : is_next ? Before::Nothing : Before::Gap;
            visit(first->second, before);
            next_ = first->first + 1;
            is_first_ = false;
            early_.erase(first);
        }
    }

    std::optional<std::int64_t> process_;
    std::int64_t next_ = 0;
    bool is_first_ = true;                  // of its process
    std::map<std::int64_t, Change> early_;  // by number
};

}  // namespace lockstep::analysis
