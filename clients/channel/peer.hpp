// The other side of a TCP connection.
#pragma once

#include <sys/socket.h>

#include <string>

namespace lockstep {

/// The address as a number, without the port. An IPv6 address is shortened to its network of 64 bits, because one host
/// may use every address in it. An IPv4 address within IPv6 is the IPv4 address. Empty if the family is another one.
std::string peer_address(const sockaddr* address);

/// True for 127.0.0.0/8 and ::1.
bool is_loopback(const sockaddr* address);

}  // namespace lockstep
