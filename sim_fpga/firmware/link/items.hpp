// The words in a message: items of consecutive words of a motor's window.
//
// An item is: the motor (1 byte), the number of words (1), the first word's number in the window (4), the words (8
// each), all little-endian.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/link/frame.hpp"

namespace lockstep::firmware {

inline constexpr std::size_t kHeaderBytes = 20;
inline constexpr std::size_t kItemBytes = 6;  // without its words

constexpr void store_bytes(std::uint8_t* to, std::uint64_t value, std::size_t bytes) {
    for (std::size_t n = 0; n < bytes; ++n) { to[n] = static_cast<std::uint8_t>(value >> 8 * n); }
}
constexpr std::uint64_t load_bytes(const std::uint8_t* from, std::size_t bytes) {
    std::uint64_t value = 0;
    for (std::size_t n = 0; n < bytes; ++n) { value |= std::uint64_t{from[n]} << 8 * n; }
    return value;
}

/// Appends words to a message that has a header.
class ItemWriter {
public:
    explicit ItemWriter(Message& message) : message_(message) { message_.size = kHeaderBytes; }

    bool is_empty() const { return message_.size == kHeaderBytes; }
    /// Whether so many words fit, wherever they are.
    bool has_room(std::size_t words) const { return message_.size + words * (kItemBytes + 8) <= kMostMessageBytes; }
    /// Whether any of so many consecutive words fit: a word that is left out takes more room than a new item does.
    bool has_room_for_run(std::size_t words) const {
        return message_.size + kItemBytes + words * 8 <= kMostMessageBytes;
    }
    /// Room for it must be there. offset: in bytes, as in the register map.
    void put(unsigned motor, std::size_t offset, std::uint64_t value) {
        if (motor != motor_ || offset != next_ || count_ == 0) { begin(motor, offset); }
        store_bytes(message_.bytes + message_.size, value, 8);
        message_.size += 8;
        message_.bytes[item_ + 1] = ++count_;
        next_ += 8;
    }

private:
    void begin(unsigned motor, std::size_t offset) {
        item_ = message_.size;
        message_.bytes[item_] = static_cast<std::uint8_t>(motor);
        store_bytes(message_.bytes + item_ + 2, offset / 8, 4);
        message_.size += kItemBytes;
        motor_ = motor;
        next_ = offset;
        count_ = 0;
    }

    Message& message_;
    std::size_t item_ = 0;  // where the present item begins
    unsigned motor_ = 0;
    std::size_t next_ = 0;  // the offset that continues the item
    std::uint8_t count_ = 0;
};

/// Calls take(motor, offset, value) for each word of a message, in order. Stops at an item that is not whole.
template <typename Take>
void for_each_word(const Message& message, Take&& take) {
    std::size_t at = kHeaderBytes;
    while (at + kItemBytes <= message.size) {
        const unsigned motor = message.bytes[at];
        const std::size_t count = message.bytes[at + 1];
        const auto first = static_cast<std::size_t>(load_bytes(message.bytes + at + 2, 4));
        at += kItemBytes;
        if (at + count * 8 > message.size) { return; }
        for (std::size_t n = 0; n < count; ++n, at += 8) {
            take(motor, (first + n) * 8, load_bytes(message.bytes + at, 8));
        }
    }
}

}  // namespace lockstep::firmware
