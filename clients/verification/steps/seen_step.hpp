// A step of the log, with the uncertainty of its time.
#pragma once

#include <cstdint>

#include "core/step/segment.hpp"
#include "core/units.hpp"

namespace lockstep::verification {

struct SeenStep {
    StepEdge edge;
    std::int64_t count = 0;  // position after it, as the log counts
    std::int64_t incarnation = 0;
    Tick machine;  // machine time at which it was made
    Ticks error;   // uncertainty of `machine`
};

/// The tolerance of a step: the uncertainty of the time when it was made, and of the commanded time. Two ticks are for
/// rounding.
inline Ticks allowed(Ticks made, Ticks commanded) {
    constexpr Ticks kRounding{2};
    const Ticks both = made + commanded;
    return both == Ticks{} ? both : both + kRounding;
}

}  // namespace lockstep::verification
