// A step as the log has it, and how far it may be from its time.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/step/segment.hpp"
#include "core/units.hpp"

namespace lockstep::verification {

struct SeenStep {
    StepEdge edge;
    std::int64_t count = 0;  // after it, by the log
    std::int64_t incarnation = 0;
    Tick machine;  // machine time at which it was made...
    Ticks error;   // ...within
};

/// What a step may be off: what is known of when it was made, and what was known when it was commanded. Two ticks are
/// for what rounding makes of it.
inline Ticks allowed(Ticks made, Ticks commanded) {
    constexpr Ticks kRounding{2};
    const Ticks both = made + commanded;
    return both == Ticks{} ? both : both + kRounding;
}

}  // namespace lockstep::verification
