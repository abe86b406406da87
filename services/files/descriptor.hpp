// An open file descriptor.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <utility>

namespace lockstep {

/// Owns a file descriptor; the destructor closes it.
class Descriptor {
public:
    explicit Descriptor(int fd = -1) : fd_(fd) {}
    Descriptor(Descriptor&& other) noexcept : fd_(other.release()) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        if (this != &other) {
            if (fd_ >= 0) { close(fd_); }
            fd_ = other.release();
        }
        return *this;
    }
    ~Descriptor() {
        if (fd_ >= 0) { close(fd_); }
    }
    int get() const { return fd_; }
    bool is_open() const { return fd_ >= 0; }
    int release() { return std::exchange(fd_, -1); }

private:
    int fd_;
};

/// Writes all bytes to a file or pipe that blocks. Returns false with the reason in errno.
inline bool write_all(const Descriptor& to, std::string_view bytes) {
    while (to.is_open() && !bytes.empty()) {
        const ssize_t written = write(to.get(), bytes.data(), bytes.size());
        if (written < 0 && errno != EINTR) { return false; }
        if (written > 0) { bytes.remove_prefix(static_cast<std::size_t>(written)); }
    }
    return to.is_open();
}

}  // namespace lockstep
