// A serial line to a board: an adapter, or a USB cable that is one for the host.
#pragma once

#include <termios.h>

#include <expected>
#include <string>

#include "services/files/descriptor.hpp"

namespace lockstep {

/// Opens a line for one program alone, raw and without waiting. When it is closed, its signal DTR falls. speed: such as
/// B1000000. Error: why it cannot be opened, and the remedy.
std::expected<Descriptor, std::string> open_serial_line(const std::string& path, speed_t speed);

}  // namespace lockstep
