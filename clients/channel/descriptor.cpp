#include "clients/channel/descriptor.hpp"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace lockstep {
namespace {

constexpr int kReadPatience_ms = 500;  // while the other side reads nothing

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

short wait_for(int fd, short events, int within_ms) {
    pollfd entry{.fd = fd, .events = events, .revents = 0};
    return poll(&entry, 1, within_ms) > 0 ? entry.revents : short{0};
}

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

}  // namespace lockstep
