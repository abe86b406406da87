// Instructions of the machines that time the pins, and their clock: 25 cycles of 40 ns a tick.
#pragma once

#include <cstdint>

namespace lockstep::firmware {

/// An instruction of a machine, and `more` of its cycles behind it.
constexpr std::uint32_t lasting(std::uint32_t instruction, std::uint32_t more) { return instruction | more << 8; }
constexpr std::uint32_t jump(std::uint32_t to) { return to; }
constexpr std::uint32_t jump_if_x_is_0(std::uint32_t to) { return 1 << 5 | to; }
constexpr std::uint32_t jump_if_x_counts_down(std::uint32_t to) { return 2 << 5 | to; }
constexpr std::uint32_t jump_if_y_is_0(std::uint32_t to) { return 3 << 5 | to; }
constexpr std::uint32_t jump_if_y_counts_down(std::uint32_t to) { return 4 << 5 | to; }

inline constexpr std::uint32_t kDividerOf200MHz = 8;

}  // namespace lockstep::firmware
