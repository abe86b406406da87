#include "services/board/link_line.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "services/board/serial_line.hpp"

namespace lockstep {
namespace {

/// Bytes that may wait in the kernel: at 1 MBd they take a millisecond.
constexpr int kMostWaiting = 100;

std::unexpected<std::string> failure(const std::string& what, const std::string& remedy) {
    return std::unexpected(what + ": " + std::strerror(errno) + "; " + remedy);
}

std::expected<LinkLine, std::string> open_serial(const std::string& path) {
    auto line = open_serial_line(path, B1000000);
    if (!line) { return std::unexpected(std::move(line.error())); }
    return LinkLine(std::move(*line));
}

std::expected<LinkLine, std::string> open_tcp(const LinkName& name) {
    const std::string place = name.place + ":" + std::to_string(name.port);
    sockaddr_in to{.sin_family = AF_INET, .sin_port = htons(name.port)};
    Descriptor line(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    if (!line.is_open() || ::inet_pton(AF_INET, name.place.c_str(), &to.sin_addr) != 1) {
        return failure(place, "name an address of four numbers");
    }
    if (::connect(line.get(), reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0) {
        return failure(place, "check that the emulated board listens there");
    }
    const int yes = 1;
    ::setsockopt(line.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    ::fcntl(line.get(), F_SETFL, O_NONBLOCK);
    return LinkLine(std::move(line));
}

}  // namespace

std::expected<LinkLine, std::string> LinkLine::open(const LinkName& name) {
    std::signal(SIGPIPE, SIG_IGN);  // a connection that the other end has closed is no reason to end
    return name.kind == LinkName::Kind::Serial ? open_serial(name.place) : open_tcp(name);
}

void LinkLine::wait(int most_ms) const {
    pollfd one{.fd = line_.get(), .events = POLLIN, .revents = 0};
    ::poll(&one, 1, most_ms);
}

std::optional<std::span<const std::uint8_t>> LinkLine::receive() {
    const ssize_t got = ::read(line_.get(), received_.data(), received_.size());
    if (got > 0) { return std::span(received_).first(static_cast<std::size_t>(got)); }
    const bool is_gone = got == 0 || (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR);
    return is_gone ? std::nullopt : std::optional(std::span<const std::uint8_t>());
}

bool LinkLine::is_free() {
    flush();
    int waiting = 0;
    if (sent_ < frame_.size) { return false; }
    return ::ioctl(line_.get(), TIOCOUTQ, &waiting) != 0 || waiting < kMostWaiting;
}

void LinkLine::send(const firmware::Frame& frame) {
    frame_ = frame;
    sent_ = 0;
    flush();
}

/// If the line is gone, receive() says so.
void LinkLine::flush() {
    while (sent_ < frame_.size) {
        const ssize_t written = ::write(line_.get(), frame_.bytes + sent_, frame_.size - sent_);
        if (written <= 0) { return; }
        sent_ += static_cast<std::size_t>(written);
    }
}

}  // namespace lockstep
