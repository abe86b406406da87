// The skip-ahead form of the step engine: from step to step in closed form, at any speed.
//
// StepEngine (core/step/engine.hpp) uses the same method for slow stretches. This form checks the other forms.
#pragma once

#include <cstdint>

#include "core/step/segment.hpp"
#include "core/step/walk.hpp"

namespace lockstep {

/// Calls on_step(StepEdge) for every step of an executable segment, in order.
template <typename OnStep>
void skip_ahead(const Segment& segment, OnStep&& on_step) {
    Position from = segment.from;
    for (Ticks done; done < segment.piece.ticks;) {
        const Velocity velocity{static_cast<std::int64_t>(segment.piece.velocity_after(done))};
        const Stretch stretch =
            next_stretch(from, velocity, segment.piece.acceleration, segment.piece.ticks - done, kNeverFast);
        const auto direction = static_cast<std::int8_t>(stretch.backward ? -1 : 1);
        walk_roots(stretch, [&](std::int64_t n) {
            on_step(StepEdge{segment.start + done + Ticks{n}, direction});
            return true;
        });
        done += Ticks{stretch.ticks};
        from = segment.from + segment.piece.covered(done);
    }
}

}  // namespace lockstep
