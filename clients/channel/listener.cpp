#include "clients/channel/listener.hpp"

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <memory>

#include "clients/channel/peer.hpp"
#include "services/files/descriptor.hpp"

namespace lockstep {
namespace {

constexpr int kBacklog = 128;
constexpr int kHostPatience_ms = 10'000;
constexpr int kProbeAfter_s = 4;
constexpr int kProbeAgainAfter_s = 2;

std::uint16_t port_of(int socket) {
    sockaddr_storage bound{};
    socklen_t size = sizeof bound;
    if (getsockname(socket, reinterpret_cast<sockaddr*>(&bound), &size) != 0) { return 0; }
    const bool is_four = bound.ss_family == AF_INET;
    return ntohs(is_four ? std::bit_cast<sockaddr_in*>(&bound)->sin_port
                         : std::bit_cast<sockaddr_in6*>(&bound)->sin6_port);
}

bool set(int socket, int level, int option, int value) {
    return setsockopt(socket, level, option, &value, sizeof value) == 0;
}

/// Ends a connection whose other host is gone without a word, for example because its cable is unplugged: probes it
/// when it is silent, and limits the wait for the acknowledgement of what was sent.
bool ends_without_other_host(int socket) {
    return set(socket, SOL_SOCKET, SO_KEEPALIVE, 1) && set(socket, IPPROTO_TCP, TCP_KEEPIDLE, kProbeAfter_s) &&
           set(socket, IPPROTO_TCP, TCP_KEEPINTVL, kProbeAgainAfter_s) &&
           set(socket, IPPROTO_TCP, TCP_USER_TIMEOUT, kHostPatience_ms);
}

}  // namespace

std::expected<Listener, std::string> listen_at(const std::string& address, std::uint16_t port) {
    const std::string place = fmt::format("address {}, port {}", address, port);
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    hints.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV;
    addrinfo* found = nullptr;
    if (getaddrinfo(address.c_str(), std::to_string(port).c_str(), &hints, &found) != 0) {
        return std::unexpected("'" + address + "' is not an IP address; write for example 127.0.0.1, ::1 or 0.0.0.0");
    }
    const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owned(found, freeaddrinfo);
    Descriptor made(socket(found->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    const bool listens = made.is_open() && set(made.get(), SOL_SOCKET, SO_REUSEADDR, 1) &&
                         ends_without_other_host(made.get()) &&  // connections inherit it
                         bind(made.get(), found->ai_addr, found->ai_addrlen) == 0 && listen(made.get(), kBacklog) == 0;
    if (!listens) {
        const char* remedy = errno == EADDRINUSE ? "; choose another port: --port N" : "";
        return std::unexpected(place + ": " + std::strerror(errno) + remedy);
    }
    const std::uint16_t bound = port_of(made.get());
    return Listener{made.release(), bound, is_loopback(found->ai_addr)};
}

}  // namespace lockstep
