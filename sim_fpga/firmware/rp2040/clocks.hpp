// The board's clocks: 200 MHz for the processor, 48 MHz for USB, from a crystal of 12 MHz.
#pragma once

namespace lockstep::firmware {

/// Also begins the timer's microseconds, and ends the reset of the parts that the firmware uses.
void start_clocks();

}  // namespace lockstep::firmware
