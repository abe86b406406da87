// Converts times of one clock to another: by their last common reading, or within a stretch of time that both measured.
#pragma once

#include <cmath>

#include "core/units.hpp"

namespace lockstep {

/// The reading of another clock near the instant at which the own clock reads `own`. With only one clock, all members
/// except `own` and `other` are 0.
struct ClockView {
    Tick own;
    Tick other;             // its reading at `own`
    double rate = 0;        // the other's ticks in one own tick, minus 1
    Ticks error;            // bound on the error of `other`
    double rate_error = 0;  // growth of that bound for each tick before or after `own`

    Tick at(Tick tick) const {
        const Ticks since = tick - own;
        return other + since + Ticks{std::llround(static_cast<double>(since.value) * rate)};
    }
    Ticks error_at(Tick tick) const {
        const double since = std::abs(static_cast<double>((tick - own).value));
        return error + Ticks{static_cast<std::int64_t>(std::ceil(since * rate_error))};
    }
};

/// The same stretch of time on two clocks. Between its ends their readings are proportional.
struct ClockStretch {
    Tick from;
    Ticks ticks;  // above 0
    Tick other_from;
    Ticks other_ticks;

    /// Rounds down. Also extrapolates beyond the ends.
    Tick at(Tick tick) const {
        if (ticks == other_ticks) { return other_from + (tick - from); }
        const Int128 share = Int128{(tick - from).value} * other_ticks.value;
        const Int128 whole = share / ticks.value - (share % ticks.value < 0 ? 1 : 0);
        return other_from + Ticks{static_cast<std::int64_t>(whole)};
    }
};

}  // namespace lockstep
