#include "clients/channel/bytes.hpp"

#include <poll.h>
#include <unistd.h>

#include <cerrno>

namespace lockstep {
namespace {

constexpr int kReadPatience_ms = 500;  // while the other side reads nothing

}  // namespace

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
