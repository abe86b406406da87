#include "services/wire/dds/interface_sockets.hpp"

#include <fmt/format.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/parse_number.hpp"

namespace lockstep {
namespace {

int option_of(int socket, int option) {
    int value = -1;
    socklen_t size = sizeof value;
    return ::getsockopt(socket, SOL_SOCKET, option, &value, &size) == 0 ? value : -1;
}

bool is_udp(int descriptor) {
    return option_of(descriptor, SO_DOMAIN) == AF_INET && option_of(descriptor, SO_TYPE) == SOCK_DGRAM;
}

}  // namespace

Descriptors udp_sockets() {
    Descriptors sockets;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
        const auto descriptor = parse_number<int>(entry.path().filename().string());
        if (descriptor && is_udp(*descriptor)) { sockets.insert(*descriptor); }
    }
    return sockets;
}

std::expected<void, std::string> tie_new_sockets(const Descriptors& before, const std::string& interface) {
    for (const int socket : udp_sockets()) {
        if (before.contains(socket)) { continue; }
        const auto size = static_cast<socklen_t>(interface.size());
        if (::setsockopt(socket, SOL_SOCKET, SO_BINDTODEVICE, interface.data(), size) != 0) {
            return std::unexpected(fmt::format(
                "cannot bind DDS's sockets to interface {}: {}; it requires Linux 5.7, or the capability CAP_NET_RAW",
                interface, std::strerror(errno)));
        }
    }
    return {};
}

/// For a socket without a peer, shutdown() reports ENOTCONN, but the kernel ends its reception nevertheless.
void end_reception(const Descriptors& sockets) {
    for (const int socket : sockets) { (void)::shutdown(socket, SHUT_RD); }
}

}  // namespace lockstep
