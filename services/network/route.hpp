// Finds the interface that the kernel uses for an address.
#pragma once

#include <expected>
#include <string>

namespace lockstep {

/// Returns the interface through which the kernel would send to this IPv4 address. Error: why there is none.
std::expected<std::string, std::string> route_interface(const std::string& address);

}  // namespace lockstep
