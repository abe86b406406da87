// The board's clocks: 125 MHz for the processor, 48 MHz for USB, from a crystal of 12 MHz.
#pragma once

#include <cstdint>

namespace lockstep::firmware {

inline constexpr std::uint32_t kClock_hz = 125'000'000;

/// Also begins the timer's microseconds, and ends the reset of the parts that the firmware uses.
void start_clocks();

}  // namespace lockstep::firmware
