// A connection to a controller: a serial line, or TCP.
#pragma once

#include <expected>
#include <string>

#include "clients/channel/bytes.hpp"

namespace lockstep {

/// `place` is HOST:PORT, or the path of a serial line that begins with / or . and runs at `baud`. The error names the
/// cause and the remedy.
std::expected<Descriptor, std::string> open_port(const std::string& place, int baud);

/// Whether open_port() supports this baud rate.
bool is_baud(int baud);

}  // namespace lockstep
