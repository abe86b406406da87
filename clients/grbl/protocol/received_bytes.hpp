// Splits a sender's bytes as grbl does: real-time bytes are taken at once, anywhere in a line; lines are kept in order.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep::grbl {

/// The maximum number of bytes of a line, and of all waiting lines.
inline constexpr std::size_t kMaxLine = 256;
inline constexpr std::size_t kMaxWaiting = 4096;

struct ReceivedLine {
    std::string text;          // without its end
    bool is_too_long = false;  // then `text` is empty
};

class ReceivedBytes {
public:
    /// Returns the real-time bytes in `bytes`. A soft reset (0x18) drops all lines received so far.
    std::vector<unsigned char> take(std::string_view bytes);
    bool has_line() const { return !lines_.empty(); }
    ReceivedLine next_line();
    /// The number of bytes that still fit.
    std::size_t room() const { return kMaxWaiting - waiting_; }
    void clear();

private:
    void end_line();

    std::deque<ReceivedLine> lines_;
    std::string line_;
    std::size_t waiting_ = 0;  // bytes of all waiting lines, plus one for each
    bool is_too_long_ = false;
    bool was_return_ = false;
};

bool is_real_time(unsigned char byte);

}  // namespace lockstep::grbl
