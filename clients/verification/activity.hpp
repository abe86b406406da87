// Notes when a machine's processes last published, to find the processes that had ended by the end of a log.
#pragma once

#include <cstdint>

namespace lockstep::verification {

/// An axis reports its position in every slot. If no message of it comes for so long while other axes are received, its
/// process has ended or does not run. If no axis publishes a step or a run for so long, none moves.
inline constexpr std::int64_t kSilence_us = 500'000;

/// The newest process of an axis, and when that process last published, in microseconds of machine time.
struct AxisActivity {
    std::int64_t incarnation = 0;
    std::int64_t received_us = 0;
    std::int64_t moved_us = 0;  // when it last published steps or a run
    bool is_moving = false;     // by its newest position
    bool announced_end = false;

    /// True if the log ends so early that messages related to the axis's newest steps and runs may be missing.
    bool is_cut() const { return !announced_end && (is_moving || received_us - moved_us <= kSilence_us); }
};

/// When any process of a machine last published, and when any last published steps or runs.
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
