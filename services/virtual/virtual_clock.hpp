// A clock that is not the machine's: it was set otherwise, runs fast or slow, and may be set again.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "core/units.hpp"

namespace lockstep {

struct VirtualClock {
    Ticks offset;
    double ppm = 0;  // fast
    Ticks step;      // it is set forward by this...
    std::optional<Tick> step_at;

    /// What it reads at a true time; `origin`: when it was switched on.
    Tick at(Tick truth, Tick origin) const {
        const double gained = static_cast<double>((truth - origin).value) * ppm * 1e-6;
        const Ticks stepped = step_at && truth >= *step_at ? step : Ticks{};
        return truth + offset + stepped + Ticks{static_cast<std::int64_t>(std::floor(gained))};
    }

    /// The true time, in ticks, at which it came to show this, had it never been set.
    double truth(Tick reading, Tick origin) const {
        const double since = static_cast<double>((reading - offset - origin).value);
        return static_cast<double>(origin.value) + since / (1 + ppm * 1e-6);
    }
};

/// An axis's process and its device may each have one.
struct AxisClocks {
    VirtualClock process;
    VirtualClock device;
};

}  // namespace lockstep
