// Where a simulated slide was at a tick, and how fast it goes, so that others know where it is until they are told
// again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/units.hpp"

namespace lockstep {

struct SlideMotion {
    std::int64_t steps = 0;  // whole steps since power-up
    Tick at;
    double steps_per_tick = 0;

    /// In steps. It counts on to `most` before and behind; beyond that the slide is where it was, because it is no
    /// longer simulated, or by another clock.
    double place(Tick now, Ticks most) const {
        const Ticks since = now - at;
        const bool is_near = since <= most && Ticks{} - since <= most;
        return static_cast<double>(steps) + (is_near ? steps_per_tick * static_cast<double>(since.value) : 0);
    }
};

/// The mean speed of a slide over its last looks.
class SlideSpeed {
public:
    /// Call it at rising ticks. Returns steps per tick.
    double look(std::int64_t steps, Tick now) {
        const Look oldest = looks_[next_];
        looks_[next_] = {steps, now};
        next_ = (next_ + 1) % looks_.size();
        const auto ticks = static_cast<double>((now - oldest.at).value);
        return ticks > 0 ? static_cast<double>(steps - oldest.steps) / ticks : 0;
    }

private:
    struct Look {
        std::int64_t steps = 0;
        Tick at;
    };
    std::array<Look, 8> looks_;
    std::size_t next_ = 0;
};

}  // namespace lockstep
