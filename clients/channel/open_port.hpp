// A connection to a controller: a serial line, or TCP.
#pragma once

#include <expected>
#include <string>

#include "clients/channel/descriptor.hpp"

namespace lockstep {

/// `place`: a path that begins with / or ., at `baud`; else HOST:PORT. Error: it cannot be opened, why, and what to do.
std::expected<Descriptor, std::string> open_port(const std::string& place, int baud);

/// Those that a serial line may have.
bool is_baud(int baud);

}  // namespace lockstep
