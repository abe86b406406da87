// The steps of a fast stretch: every tick is executed, 64 at a time without a branch, and the carries are collected in
// a word. Its cost is per tick, not per step.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/step/stretch.hpp"

namespace lockstep {

/// Calls step(n) for the tick n of every step in order, until it returns false. The ticks done: n then, else all.
template <typename Step>
std::int64_t walk_ticks(const Stretch& stretch, Step&& step) {
    constexpr std::int64_t kBlock = 64;
    std::uint64_t phase = stretch.phase;
    std::uint64_t speed = stretch.speed;
    for (std::int64_t done = 0; done < stretch.ticks; done += kBlock) {
        const std::int64_t block = std::min(kBlock, stretch.ticks - done);
        std::uint64_t carries = 0;  // the first tick's ends up highest
        for (std::int64_t i = 0; i < block; ++i) {
            carries += carries + (__builtin_add_overflow(phase, speed, &phase) ? 1 : 0);
            speed += static_cast<std::uint64_t>(stretch.acceleration);
        }
        carries <<= kBlock - block;
        while (carries != 0) {
            const int i = std::countl_zero(carries);
            carries ^= (std::uint64_t{1} << 63) >> i;
            if (!step(done + i + 1)) {
                return done + i + 1;
            }
        }
    }
    return stretch.ticks;
}

}  // namespace lockstep
