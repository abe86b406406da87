// When a machine's processes last published: shows which of them had ended by the end of a log.
#pragma once

#include <cstdint>

namespace lockstep::verification {

/// An axis reports its position in every slot. An axis that is not received for so long while others are has ended, or
/// stands still; if no axis has published a step or a run for so long, none moves.
inline constexpr std::int64_t kSilence_us = 500'000;

/// Of an axis: its newest process, and when that last published, in microseconds of machine time.
struct AxisActivity {
    std::int64_t incarnation = 0;
    std::int64_t received_us = 0;
    std::int64_t moved_us = 0;  // when it last published steps or a run
    bool is_moving = false;     // by its newest position
    bool announced_end = false;

    /// Whether the log ends so early that messages related to its newest steps and runs may be missing.
    bool is_cut() const { return !announced_end && (is_moving || received_us - moved_us <= kSilence_us); }
};

/// Of a machine: when any process last published, and when any last published steps or runs.
struct MachineActivity {
    std::int64_t received_us = 0;
    std::int64_t moved_us = 0;

    bool has_ended(const AxisActivity& axis) const { return received_us - axis.received_us > kSilence_us; }
    bool has_ended(const AxisActivity& axis, std::int64_t incarnation) const {
        return axis.incarnation != incarnation || has_ended(axis);
    }
    bool are_at_rest() const { return received_us - moved_us > kSilence_us; }
};

}  // namespace lockstep::verification
