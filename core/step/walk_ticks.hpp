// The steps of a fast stretch: every tick is executed, 64 at a time without a branch, and the carries are collected in
// a word. Its cost is per tick, not per step.
#pragma once

#include <bit>
#include <cstdint>

#include "core/step/stretch.hpp"

namespace lockstep {

/// Executes 64 ticks: bit 63 of the result is the first one's carry, bit 0 the last one's.
inline std::uint64_t tick_64_times(std::uint64_t& phase, std::uint64_t& speed, std::uint64_t acceleration) {
    std::uint64_t carries = 0;
    std::uint64_t p = phase;
    std::uint64_t v = speed;
#pragma GCC unroll 64
    for (int i = 0; i < 64; ++i) {
        p += v;
        carries += carries + (p < v ? 1 : 0);
        v += acceleration;
    }
    phase = p;
    speed = v;
    return carries;
}

/// Calls step(n) for the tick n of every step in order, until it returns false. Returns the ticks done: n or all.
template <typename Step>
std::int64_t walk_ticks(const Stretch& stretch, Step&& step) {
    std::uint64_t phase = stretch.phase;
    std::uint64_t speed = stretch.speed;
    for (std::int64_t done = 0; done < stretch.ticks; done += 64) {
        std::uint64_t carries = tick_64_times(phase, speed, static_cast<std::uint64_t>(stretch.acceleration));
        if (const std::int64_t left = stretch.ticks - done; left < 64) { carries &= ~(~std::uint64_t{0} >> left); }
        while (carries != 0) {
            const int i = std::countl_zero(carries);
            carries ^= (std::uint64_t{1} << 63) >> i;
            if (!step(done + i + 1)) { return done + i + 1; }
        }
    }
    return stretch.ticks;
}

}  // namespace lockstep
