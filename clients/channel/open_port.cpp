#include "clients/channel/open_port.hpp"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

namespace lockstep {
namespace {

constexpr int kConnectPatience_ms = 5000;
constexpr std::array<std::pair<int, speed_t>, 7> kSpeeds{{{9600, B9600},
                                                          {19200, B19200},
                                                          {38400, B38400},
                                                          {57600, B57600},
                                                          {115200, B115200},
                                                          {230400, B230400},
                                                          {921600, B921600}}};

std::unexpected<std::string> failure(const std::string& place, const std::string& why) {
    return std::unexpected(place + ": " + why);
}

std::optional<speed_t> speed_of(int baud) {
    for (const auto& [number, speed] : kSpeeds) {
        if (number == baud) { return speed; }
    }
    return std::nullopt;
}

std::expected<Descriptor, std::string> open_serial(const std::string& path, int baud) {
    Descriptor port(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!port.is_open()) {
        return failure(
            path, std::string(std::strerror(errno)) +
                      (errno == EACCES ? "; check that this user may use it, often with: adduser USER dialout" : ""));
    }
    termios mode{};
    if (tcgetattr(port.get(), &mode) != 0) { return failure(path, "this is not a serial line or terminal"); }
    cfmakeraw(&mode);
    mode.c_cflag |= CLOCAL | CREAD;
    const speed_t speed = speed_of(baud).value_or(B115200);
    cfsetispeed(&mode, speed);
    cfsetospeed(&mode, speed);
    if (tcsetattr(port.get(), TCSANOW, &mode) != 0) { return failure(path, std::strerror(errno)); }
    return port;
}

bool connects(int fd, const addrinfo& to) {
    if (connect(fd, to.ai_addr, to.ai_addrlen) == 0) { return true; }
    if (errno != EINPROGRESS) { return false; }
    if ((wait_for(fd, POLLOUT, kConnectPatience_ms) & POLLOUT) == 0) {
        errno = ETIMEDOUT;
        return false;
    }
    socklen_t size = sizeof errno;
    return getsockopt(fd, SOL_SOCKET, SO_ERROR, &errno, &size) == 0 && errno == 0;
}

std::expected<Descriptor, std::string> open_tcp(const std::string& place, std::size_t colon) {
    const addrinfo wanted{.ai_family = AF_UNSPEC, .ai_socktype = SOCK_STREAM};
    addrinfo* found = nullptr;
    const int error = getaddrinfo(place.substr(0, colon).c_str(), place.substr(colon + 1).c_str(), &wanted, &found);
    if (error != 0) { return failure(place, gai_strerror(error)); }
    const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> all(found, freeaddrinfo);
    for (const addrinfo* to = found; to != nullptr; to = to->ai_next) {
        Descriptor port(socket(to->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
        if (!port.is_open() || !connects(port.get(), *to)) { continue; }
        const int yes = 1;
        setsockopt(port.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
        return port;
    }
    return failure(place,
                   std::string(std::strerror(errno)) + "; check that lockstep-grbl or a controller listens there");
}

}  // namespace

bool is_baud(int baud) { return speed_of(baud).has_value(); }

std::expected<Descriptor, std::string> open_port(const std::string& place, int baud) {
    const std::size_t colon = place.rfind(':');
    const bool is_path = place.starts_with('/') || place.starts_with('.');
    if (!is_path && colon != std::string::npos && colon > 0) { return open_tcp(place, colon); }
    return open_serial(place, baud);
}

}  // namespace lockstep
