// The interface that the kernel uses for an address.
#pragma once

#include <expected>
#include <string>

namespace lockstep {

/// The interface by which the kernel would send to this IPv4 address. Error: there is none, with the reason.
std::expected<std::string, std::string> route_interface(const std::string& address);

}  // namespace lockstep
