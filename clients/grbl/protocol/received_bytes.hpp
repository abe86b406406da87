// What a sender has written, as grbl reads it: real-time bytes at once, wherever they stand, and lines in their order.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep::grbl {

/// The most bytes of a line, and of all lines that wait.
inline constexpr std::size_t kMaxLine = 256;
inline constexpr std::size_t kMaxWaiting = 4096;

struct ReceivedLine {
    std::string text;          // without its end
    bool is_too_long = false;  // and `text` is empty
};

class ReceivedBytes {
public:
    /// Returns the real-time bytes among them. A soft reset (0x18) drops all lines received so far.
    std::vector<unsigned char> take(std::string_view bytes);
    bool has_line() const { return !lines_.empty(); }
    ReceivedLine next_line();
    /// Bytes that still fit.
    std::size_t room() const { return kMaxWaiting - waiting_; }
    void clear();

private:
    void end_line();

    std::deque<ReceivedLine> lines_;
    std::string line_;
    std::size_t waiting_ = 0;  // bytes of all lines, and one more for each
    bool is_too_long_ = false;
    bool was_return_ = false;
};

bool is_real_time(unsigned char byte);

}  // namespace lockstep::grbl
