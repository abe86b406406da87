#include "clients/channel/peer.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <algorithm>
#include <bit>
#include <cstdint>

namespace lockstep {
namespace {

constexpr std::size_t kNetwork_bytes = 8;

std::string text_of(int family, const void* address) {
    char text[INET6_ADDRSTRLEN] = {};
    return inet_ntop(family, address, text, sizeof text) == nullptr ? "" : text;
}

}  // namespace

std::string peer_address(const sockaddr* address) {
    if (address->sa_family == AF_INET) {
        return text_of(AF_INET, &std::bit_cast<const sockaddr_in*>(address)->sin_addr);
    }
    if (address->sa_family != AF_INET6) { return ""; }
    in6_addr six = std::bit_cast<const sockaddr_in6*>(address)->sin6_addr;
    constexpr std::size_t kMapped = 12;  // bytes before the IPv4 address
    if (IN6_IS_ADDR_V4MAPPED(&six)) { return text_of(AF_INET, six.s6_addr + kMapped); }
    if (IN6_IS_ADDR_LOOPBACK(&six)) { return text_of(AF_INET6, &six); }
    std::fill(six.s6_addr + kNetwork_bytes, six.s6_addr + sizeof six.s6_addr, std::uint8_t{0});
    return text_of(AF_INET6, &six) + "/64";
}

bool is_loopback(const sockaddr* address) {
    if (address->sa_family == AF_INET) {
        const auto* four = std::bit_cast<const sockaddr_in*>(address);
        return (ntohl(four->sin_addr.s_addr) >> 24) == 127;
    }
    return IN6_IS_ADDR_LOOPBACK(&std::bit_cast<const sockaddr_in6*>(address)->sin6_addr);
}

}  // namespace lockstep
