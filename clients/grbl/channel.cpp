#include "clients/grbl/channel.hpp"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace lockstep::grbl {
namespace {

std::unexpected<std::string> failure(const std::string& what) {
    return std::unexpected(what + ": " + std::strerror(errno));
}

}  // namespace

std::optional<Descriptor> accept_from(const Descriptor& listener) {
    Descriptor connection(accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!connection.is_open()) { return std::nullopt; }
    const int yes = 1;
    setsockopt(connection.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    return connection;
}

std::string peer_of(const Descriptor& connection) {
    sockaddr_storage place{};
    socklen_t size = sizeof place;
    auto* generic = reinterpret_cast<sockaddr*>(&place);
    char text[NI_MAXHOST] = {};
    const bool is_known = getpeername(connection.get(), generic, &size) == 0 &&
                          getnameinfo(generic, size, text, sizeof text, nullptr, 0, NI_NUMERICHOST) == 0;
    return is_known ? text : "";
}

/// Opens the other end once and closes it, to set it to raw mode and so that poll() reports POLLHUP while nobody uses
/// it.
std::expected<Terminal, std::string> Terminal::open(const std::string& link) {
    Descriptor master(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!master.is_open() || grantpt(master.get()) != 0 || unlockpt(master.get()) != 0) {
        return failure("a pseudo-terminal cannot be opened");
    }
    char name[64];
    if (ptsname_r(master.get(), name, sizeof name) != 0) { return failure("a pseudo-terminal has no name"); }
    const Descriptor other(::open(name, O_RDWR | O_NOCTTY | O_CLOEXEC));
    termios mode{};
    if (!other.is_open() || tcgetattr(other.get(), &mode) != 0) { return failure(std::string(name)); }
    cfmakeraw(&mode);
    (void)tcsetattr(other.get(), TCSANOW, &mode);
    char target[64];
    const ssize_t length = readlink(link.c_str(), target, sizeof target);
    const bool is_left_over = length > 9 && std::strncmp(target, "/dev/pts/", 9) == 0;
    if (is_left_over) { (void)unlink(link.c_str()); }
    if (symlink(name, link.c_str()) != 0) { return failure("cannot make " + link); }
    return Terminal(std::move(master), link);
}

Terminal::Terminal(Terminal&& other) noexcept
    : master_(std::move(other.master_)), link_(std::exchange(other.link_, {})) {}

Terminal::~Terminal() {
    if (!link_.empty()) { (void)unlink(link_.c_str()); }
}

bool Terminal::is_used() const { return (wait_for(master_.get(), POLLIN, 0) & POLLHUP) == 0; }

}  // namespace lockstep::grbl
