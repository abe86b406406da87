// Bytes through a file descriptor that does not block.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "services/files/descriptor.hpp"

namespace lockstep {

/// Returns the bytes that arrive within the time; empty if none arrive, nullopt if the other side has closed the
/// connection.
std::optional<std::string> read_from(const Descriptor& from, std::chrono::milliseconds within);
/// Returns false if the other side is gone or has read nothing for 500 ms.
bool write_to(const Descriptor& to, const std::string& bytes);

/// Calls poll() and returns the events that occurred: those of `events`, and POLLERR, POLLHUP and POLLNVAL, which
/// poll() always reports. Returns 0 if the time expires.
short wait_for(int fd, short events, int within_ms);

}  // namespace lockstep
