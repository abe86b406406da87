#include "clients/grbl/channel.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace lockstep::grbl {
namespace {

constexpr int kReadPatience_ms = 500;  // for a sender that reads nothing

std::unexpected<std::string> failure(const std::string& what) {
    return std::unexpected(what + ": " + std::strerror(errno));
}

short wait_for(int fd, short events, int within_ms) {
    pollfd entry{.fd = fd, .events = events, .revents = 0};
    return poll(&entry, 1, within_ms) > 0 ? entry.revents : short{0};
}

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
    if (this != &other) {
        if (fd_ >= 0) { close(fd_); }
        fd_ = other.release();
    }
    return *this;
}

Descriptor::~Descriptor() {
    if (fd_ >= 0) { close(fd_); }
}

int Descriptor::release() { return std::exchange(fd_, -1); }

std::expected<Descriptor, std::string> listen_at(const std::string& address, std::uint16_t port) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    if (inet_pton(AF_INET, address.c_str(), &place.sin_addr) != 1) {
        return std::unexpected("'" + address + "' is no address such as 127.0.0.1");
    }
    Descriptor listener(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    if (!listener.is_open()) { return failure("a socket cannot be opened"); }
    const int yes = 1;
    setsockopt(listener.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    const std::string where = address + ", port " + std::to_string(port);
    const auto* generic = reinterpret_cast<const sockaddr*>(&place);
    if (bind(listener.get(), generic, sizeof place) != 0) { return failure("cannot listen at " + where); }
    if (listen(listener.get(), 4) != 0) { return failure("cannot listen at " + where); }
    return listener;
}

std::optional<Descriptor> accept_from(const Descriptor& listener) {
    Descriptor connection(accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!connection.is_open()) { return std::nullopt; }
    const int yes = 1;
    setsockopt(connection.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    return connection;
}

std::string peer_of(const Descriptor& connection) {
    sockaddr_in place{};
    socklen_t size = sizeof place;
    char text[INET_ADDRSTRLEN] = {};
    const bool is_known = getpeername(connection.get(), reinterpret_cast<sockaddr*>(&place), &size) == 0 &&
                          place.sin_family == AF_INET &&
                          inet_ntop(AF_INET, &place.sin_addr, text, sizeof text) != nullptr;
    return is_known ? text : "";
}

/// The other end is opened once, so that it is raw, and that its hang-up can be seen.
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

std::optional<std::string> read_from(const Descriptor& from, std::chrono::milliseconds within) {
    const short ready = wait_for(from.get(), POLLIN, static_cast<int>(within.count()));
    if (ready == 0) { return std::string(); }
    char bytes[4096];
    const ssize_t count = read(from.get(), bytes, sizeof bytes);
    if (count > 0) { return std::string(bytes, static_cast<std::size_t>(count)); }
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) { return std::string(); }
    return std::nullopt;
}

bool write_to(const Descriptor& to, const std::string& bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t count = write(to.get(), bytes.data() + done, bytes.size() - done);
        if (count > 0) {
            done += static_cast<std::size_t>(count);
        } else if (errno != EINTR &&
                   (errno != EAGAIN || (wait_for(to.get(), POLLOUT, kReadPatience_ms) & POLLOUT) == 0)) {
            return false;
        }
    }
    return true;
}

}  // namespace lockstep::grbl
