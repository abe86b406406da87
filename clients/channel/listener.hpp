// A listening TCP socket.
#pragma once

#include <cstdint>
#include <expected>
#include <string>

namespace lockstep {

struct Listener {
    int socket = -1;  // its owner closes it
    std::uint16_t port = 0;
    bool is_loopback = false;
};

/// `address` is an IPv4 or IPv6 address. Port 0 selects any free port. Connections end when the other host has not
/// answered for 10 s. The error names the cause and the remedy.
std::expected<Listener, std::string> listen_at(const std::string& address, std::uint16_t port);

}  // namespace lockstep
