// Keeps LCM's multicast where the configuration says. LCM leaves the choice of the interface to the routing table,
// and a machine's default route may lead anywhere. (DDS does not need this: it is bound to its interface by name.)
//
// The rule: a datagram with ttl 0 never leaves the host, whatever the route; with a larger ttl it goes where the route
// says, so the route must be that of the configured interface, or nothing is published. With no route at all the
// kernel refuses to send.
#pragma once

#include <cstdint>
#include <expected>
#include <string>
#include <string_view>

#include "core/machine.hpp"

namespace lockstep {

/// What an LCM URL says, e.g. udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304; what is missing has LCM's default.
struct LcmUrl {
    std::string provider = "udpm";
    std::string address = "239.255.76.67";
    std::uint16_t port = 7667;
    int ttl = 0;

    bool is_multicast() const { return provider == "udpm"; }
};

/// Error: a port or ttl that is no number in range, an address that is no IPv4 multicast address.
std::expected<LcmUrl, std::string> parse_lcm_url(std::string_view url);

/// The interface by which the kernel would send to this IPv4 address. Error: there is none; the text says so.
std::expected<std::string, std::string> route_interface(const std::string& address);

/// Whether LCM may publish under this configuration. Error: why not, and the remedy.
std::expected<void, std::string> check_multicast(const NetworkConfig& network);

/// Routes multicast to lo, for a machine that is whole on one host: adds the route where it is missing, which takes
/// root. True: it was added; false: it was there. Error: what failed and the remedy.
std::expected<bool, std::string> ensure_loopback_multicast();

/// Takes back what ensure_loopback_multicast added.
std::expected<void, std::string> remove_loopback_multicast();

}  // namespace lockstep
