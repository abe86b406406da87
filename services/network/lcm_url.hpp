// Parses an LCM URL.
#pragma once

#include <cstdint>
#include <expected>
#include <string>
#include <string_view>

namespace lockstep {

/// The parts of an LCM URL, e.g. udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304; a missing part has a default.
struct LcmUrl {
    std::string provider = "udpm";
    std::string address = "239.255.76.67";
    std::uint16_t port = 7667;
    int ttl = 0;

    bool is_multicast() const { return provider == "udpm" || provider == "mpudpm"; }
};

/// Error: the port or ttl is not a number in range, or the address is not an IPv4 multicast address.
std::expected<LcmUrl, std::string> parse_lcm_url(std::string_view url);

}  // namespace lockstep
