// When a machine's processes were last heard of: what the end of a log says of who had ended by then.
#pragma once

#include <cstdint>

namespace lockstep::verification {

/// An axis says where it is in every slot. One that is not heard for so long while others are has ended, or stands
/// still; and where nobody has told of a step or a run for so long, nobody moves.
inline constexpr std::int64_t kSilence_us = 500'000;

/// Of an axis: its newest process, and when that was last heard, in microseconds of machine time.
struct LastWord {
    std::int64_t incarnation = 0;
    std::int64_t said_us = 0;
    std::int64_t moved_us = 0;  // when it last published steps or a run
    bool is_moving = false;     // by its newest position
    bool said_its_end = false;

    /// Whether the log ends before all can have come that its newest steps and runs come with.
    bool is_cut() const { return !said_its_end && (is_moving || said_us - moved_us <= kSilence_us); }
};

/// Of a machine: when anybody was last heard, and when they last told of steps or runs.
struct LastWords {
    std::int64_t said_us = 0;
    std::int64_t moved_us = 0;

    bool has_ended(const LastWord& axis) const { return said_us - axis.said_us > kSilence_us; }
    bool has_ended(const LastWord& axis, std::int64_t incarnation) const {
        return axis.incarnation != incarnation || has_ended(axis);
    }
    bool are_at_rest() const { return said_us - moved_us > kSilence_us; }
};

}  // namespace lockstep::verification
