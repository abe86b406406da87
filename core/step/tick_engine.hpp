// The reference form of the step engine: tick by tick, additions only, as in hardware.
//
// The phase register is position + 1/2 step, modulo one step. A step forward is the carry of phase + velocity, a step
// backward its borrow. Every other form, and the RTL, must make the same steps at the same ticks.
// Method: P. Ranade, "Linear motor control without the math", with second-order accumulation and half-step crossings.
#pragma once

#include <cstdint>

#include "core/step/executable.hpp"
#include "core/step/segment.hpp"

namespace lockstep {

/// The engine's three registers. Two's complement: all sums wrap.
struct Accumulator {
    std::uint64_t phase = 0;
    std::uint64_t velocity = 0;
    std::uint64_t acceleration = 0;

    constexpr Accumulator(Position from, const Piece& piece)
        : phase(from.phase()),
          velocity(static_cast<std::uint64_t>(piece.velocity.raw)),
          acceleration(static_cast<std::uint64_t>(piece.acceleration.raw)) {}

    /// Executes one tick and returns its step: +1, -1 or 0.
    constexpr std::int8_t tick() {
        velocity += acceleration;
        const std::uint64_t before = phase;
        phase += velocity;
        const bool backward = static_cast<std::int64_t>(velocity) < 0;
        if (backward) { return phase > before ? -1 : 0; }
        return phase < before ? 1 : 0;
    }
};

/// Calls on_step(StepEdge) for every step of an executable segment, in order.
template <typename OnStep>
void tick_by_tick(const Segment& segment, OnStep&& on_step) {
    Accumulator axis(segment.from, segment.piece);
    for (Tick now = segment.start; now < segment.end();) {
        now += Ticks{1};
        if (const std::int8_t direction = axis.tick(); direction != 0) { on_step(StepEdge{now, direction}); }
    }
}

}  // namespace lockstep
