// The mode in which the chip's plug shows a drive, for another firmware.
#pragma once

namespace lockstep::firmware {

/// Ends the firmware. No motor may be enabled.
[[noreturn]] void enter_boot_mode();

}  // namespace lockstep::firmware
