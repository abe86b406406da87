// Words of a motor's window beside the register map, by which lockstep-board tells the motor's process when the
// window's registers were true. They change together with SEQUENCE.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "sim_fpga/firmware/link/look_word.hpp"

namespace lockstep::firmware {

// The registers were true between these two times of CLOCK_MONOTONIC, in nanoseconds.
inline constexpr std::size_t kAskedWord = kLookWord + 0x08;
inline constexpr std::size_t kAnsweredWord = kLookWord + 0x10;
/// The ticks that the board's clock had counted beyond TICK: a board executes ticks in blocks.
inline constexpr std::size_t kBehindWord = kLookWord + 0x18;
/// 1 while the board answers.
inline constexpr std::size_t kAnswersWord = kLookWord + 0x20;

/// The shared memory of a motor's window.
inline std::string board_window_name(const std::string& machine, const std::string& board, unsigned motor) {
    return "lockstep-" + machine + "-" + board + "-" + std::to_string(motor);
}

}  // namespace lockstep::firmware
