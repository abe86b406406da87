// Which way the kernel sends.
#pragma once

#include <expected>
#include <string>

namespace lockstep {

/// The interface by which the kernel would send to this IPv4 address. Error: there is none; the text says so.
std::expected<std::string, std::string> route_interface(const std::string& address);

}  // namespace lockstep
