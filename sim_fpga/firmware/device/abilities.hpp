// The sizes of the board's rings, and the words of the register map that never change.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lockstep::firmware {

// Entries of a motor's rings. They are memory: 56 kB for each motor, of the 264 kB of an RP2040.
inline constexpr std::size_t kSegmentRoom = 1024;
inline constexpr std::size_t kCaptureRoom = 2048;
inline constexpr std::size_t kOutputRoom = 64;
inline constexpr std::size_t kEventRoom = 64;

// The largest frame, with the numbers of core/protocol/messages.hpp and core/hardware/output_change.hpp.
inline constexpr std::size_t kMostPieces = 274;
inline constexpr std::size_t kMostBodyChanges = 192;
inline constexpr std::size_t kMostTailChanges = 64;
/// The longest piece, as in core/step/executable.hpp.
inline constexpr std::int64_t kLongestPiece = std::int64_t{1} << 42;

inline constexpr std::size_t kMostInputs = 32;
inline constexpr std::size_t kMostAnalog = 8;

/// Of one motor.
struct Abilities {
    std::uint64_t tick_ns = 1000;
    std::uint64_t power_up = 0;
    std::uint64_t least_step_ticks = 2;
    std::uint64_t lead_ticks = 0;
    std::uint64_t pin_ticks = 0;
    std::uint64_t time_unit_ps = 1000;
    std::uint64_t longest_time = 1'000'000'000;
    std::uint64_t longest_pwm_period = 1'000'000'000;
    std::uint64_t inputs = 0;
    std::uint64_t digital_outputs = 0;
    std::uint64_t analog_outputs = 0;
    bool has_encoder = false;
    bool can_enable = false;
    bool can_compare = true;
};

}  // namespace lockstep::firmware
