// A clock that differs from the true time: it has an offset, runs rate error; positive: the clock runs fast or slow,
// and may be set again.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "core/units.hpp"

namespace lockstep {

struct VirtualClock {
    Ticks offset;
    double ppm = 0;  // fast
    Ticks step;      // the clock is set forward by this at step_at
    std::optional<Tick> step_at;

    /// Returns the clock's reading at the true time `truth`. `origin` is when it was switched on.
    Tick at(Tick truth, Tick origin) const {
        const double gained = static_cast<double>((truth - origin).value) * ppm * 1e-6;
        const Ticks stepped = step_at && truth >= *step_at ? step : Ticks{};
        return truth + offset + stepped + Ticks{static_cast<std::int64_t>(std::floor(gained))};
    }

    /// Returns the true time, in ticks, at which the clock reads `reading`. It ignores `step`.
    double truth(Tick reading, Tick origin) const {
        const double since = static_cast<double>((reading - offset - origin).value);
        return static_cast<double>(origin.value) + since / (1 + ppm * 1e-6);
    }
};

/// The clocks of an axis's process and of its device.
struct AxisClocks {
    VirtualClock process;
    VirtualClock device;
};

}  // namespace lockstep
