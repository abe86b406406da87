// Bytes through a file descriptor that does not block.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace lockstep {

/// Closed with the object.
class Descriptor {
public:
    explicit Descriptor(int fd = -1) : fd_(fd) {}
    Descriptor(Descriptor&& other) noexcept : fd_(other.release()) {}
    Descriptor& operator=(Descriptor&& other) noexcept;
    ~Descriptor();
    int get() const { return fd_; }
    bool is_open() const { return fd_ >= 0; }
    int release();

private:
    int fd_;
};

/// The bytes that arrive within the time, perhaps none. nullopt: the other side has closed the connection.
std::optional<std::string> read_from(const Descriptor& from, std::chrono::milliseconds within);
/// False: the other side is gone, or has not read for long.
bool write_to(const Descriptor& to, const std::string& bytes);

/// poll(): the events of `events` that came, and those that always come.
short wait_for(int fd, short events, int within_ms);

}  // namespace lockstep
