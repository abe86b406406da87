// Which job each step belongs to. Jobs take turns: from the begin of a turn on, all steps belong to its job.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "core/units.hpp"

namespace lockstep::analysis {

class JobTurns {
public:
    /// The newest turns that are kept.
    static constexpr std::size_t kKept = 64;

    void begin(std::size_t job, Tick from) {
        if (turns_.size() == kKept) { turns_.erase(turns_.begin()); }
        turns_.push_back({from, job});
    }
    /// The number of the job; nullopt before the first turn.
    std::optional<std::size_t> job_at(Tick tick) const {
        const auto turn = std::find_if(turns_.rbegin(), turns_.rend(), [&](const Turn& t) { return t.from <= tick; });
        return turn == turns_.rend() ? std::nullopt : std::optional(turn->job);
    }
    /// When the next turn begins after a tick.
    Tick next_after(Tick tick) const {
        Tick next{std::numeric_limits<std::int64_t>::max()};
        for (const Turn& turn : turns_) {
            if (turn.from > tick) { next = std::min(next, turn.from); }
        }
        return next;
    }

private:
    struct Turn {
        Tick from;
        std::size_t job = 0;
    };
    std::vector<Turn> turns_;  // in the order in which they began
};

}  // namespace lockstep::analysis
