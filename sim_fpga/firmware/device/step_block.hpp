// The steps of a motor in a few consecutive ticks.
#pragma once

#include <cstdint>

namespace lockstep::firmware {

/// The most ticks in a block.
inline constexpr std::uint32_t kBlockTicks = 32;

/// At most one step a tick, all in one direction. Steps are counted from 0.
struct StepBlock {
    std::int64_t begin;               // the tick before the block
    int direction;                    // 1 or -1
    std::uint32_t size;               // how many steps
    std::uint8_t after[kBlockTicks];  // step n is made so many ticks after the begin

    std::int64_t tick(std::uint32_t n) const { return begin + after[n]; }
};

/// The part of a block that is taken.
struct TakenSteps {
    std::uint32_t steps = 0;  // the first so many
    bool pauses = false;      // no tick behind the last of them is executed: something is due
};

}  // namespace lockstep::firmware
