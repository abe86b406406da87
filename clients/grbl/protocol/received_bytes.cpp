#include "clients/grbl/protocol/received_bytes.hpp"

#include <utility>

namespace lockstep::grbl {
namespace {

constexpr unsigned char kResetByte = 0x18;

}  // namespace

/// All bytes above ASCII are real-time bytes; text has none of them.
bool is_real_time(unsigned char byte) {
    return byte == '?' || byte == '!' || byte == '~' || byte == kResetByte || byte >= 0x80;
}

std::vector<unsigned char> ReceivedBytes::take(std::string_view bytes) {
    std::vector<unsigned char> real_time;
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        if (is_real_time(byte)) {
            if (byte == kResetByte) { clear(); }
            real_time.push_back(byte);
            continue;
        }
        const bool is_second_of_two = c == '\n' && was_return_;
        was_return_ = c == '\r';
        if (is_second_of_two) { continue; }
        if (c == '\r' || c == '\n') {
            end_line();
        } else if (line_.size() == kMaxLine || room() <= 1) {
            is_too_long_ = true;
        } else {
            line_ += c;
            ++waiting_;
        }
    }
    return real_time;
}

/// Keeps a line that is too long or found no room without its text, to be refused in its turn. Drops it if there is no
/// room even for that.
void ReceivedBytes::end_line() {
    if (is_too_long_) {
        waiting_ -= line_.size();
        line_.clear();
    }
    if (room() > 0) {
        ++waiting_;
        lines_.push_back({std::exchange(line_, {}), is_too_long_});
    }
    is_too_long_ = false;
}

ReceivedLine ReceivedBytes::next_line() {
    ReceivedLine line = std::move(lines_.front());
    lines_.pop_front();
    waiting_ -= line.text.size() + 1;
    return line;
}

void ReceivedBytes::clear() {
    lines_.clear();
    line_.clear();
    waiting_ = 0;
    is_too_long_ = was_return_ = false;
}

}  // namespace lockstep::grbl
