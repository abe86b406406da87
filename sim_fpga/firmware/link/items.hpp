// The words in a message: items of consecutive words of a motor's window.
//
// An item is: the motor (1 byte), the number of words (1), the first word's number in the window (4), the words, all
// little-endian. A word has as many bytes as it needs as a signed number, from 0 to 8. Before two words is a byte with
// their numbers of bytes, that of the first one in the lower half.
//
// If bit 7 of the motor is set, the first word has 8 bytes and each word behind it is its distance from the one before:
// 7 bits a byte, the lowest first, with bit 7 set in all bytes but the last. So the tick of a step takes two bytes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/link/frame.hpp"

namespace lockstep::firmware {

inline constexpr std::size_t kHeaderBytes = 20;
inline constexpr std::size_t kItemBytes = 6;  // without its words
inline constexpr unsigned kRisingWords = 0x80;
inline constexpr std::size_t kMostDistanceBytes = 10;

constexpr void store_bytes(std::uint8_t* to, std::uint64_t value, std::size_t bytes) {
    for (std::size_t n = 0; n < bytes; ++n) { to[n] = static_cast<std::uint8_t>(value >> 8 * n); }
}
constexpr std::uint64_t load_bytes(const std::uint8_t* from, std::size_t bytes) {
    std::uint64_t value = 0;
    for (std::size_t n = 0; n < bytes; ++n) { value |= std::uint64_t{from[n]} << 8 * n; }
    return value;
}

/// How many bytes the word needs as a signed number.
constexpr std::size_t bytes_needed(std::uint64_t value) {
    const auto number = static_cast<std::int64_t>(value);
    const auto bits = static_cast<std::uint64_t>(number < 0 ? ~number : number);
    std::size_t bytes = 0;
    while (bytes < 8 && bits >> (bytes == 0 ? 0 : 8 * bytes - 1) != 0) { ++bytes; }
    return number == -1 ? 1 : bytes;
}
/// The word of so many bytes.
constexpr std::uint64_t load_signed(const std::uint8_t* from, std::size_t bytes) {
    const std::uint64_t value = load_bytes(from, bytes);
    const bool is_negative = bytes > 0 && bytes < 8 && (value >> (8 * bytes - 1) & 1) != 0;
    return is_negative ? value | ~std::uint64_t{0} << 8 * bytes : value;
}

/// Appends words to a message that has a header.
class ItemWriter {
public:
    explicit ItemWriter(Message& message) : message_(message) { message_.size = kHeaderBytes; }

    bool is_empty() const { return message_.size == kHeaderBytes; }
    /// Whether so many words fit, wherever they are.
    bool has_room(std::size_t words) const { return message_.size + words * (kItemBytes + 9) <= kMostMessageBytes; }
    /// Whether any of so many consecutive words fit: words that are left out take no less room than a new item does.
    bool has_room_for_run(std::size_t words) const {
        return message_.size + kItemBytes + (words + 1) / 2 + words * 8 <= kMostMessageBytes;
    }
    /// Room for it must be there. offset: in bytes, as in the register map.
    void put(unsigned motor, std::size_t offset, std::uint64_t value) {
        if (!continues(motor, offset)) { begin(motor, offset); }
        const std::size_t bytes = bytes_needed(value);
        if (count_ % 2 == 0) {
            sizes_ = message_.size;
            put_bytes(bytes, 1);
        } else {
            message_.bytes[sizes_] = static_cast<std::uint8_t>(message_.bytes[sizes_] | bytes << 4);
        }
        put_bytes(value, bytes);
        count();
    }
    /// The same for a word that is greater than the one before it, in fewer bytes.
    void put_rising(unsigned motor, std::size_t offset, std::uint64_t value) {
        if (continues(motor | kRisingWords, offset)) {
            put_distance(value - last_);
        } else {
            begin(motor | kRisingWords, offset);
            put_bytes(value, 8);
        }
        last_ = value;
        count();
    }

private:
    bool continues(unsigned motor, std::size_t offset) const {
        return motor == motor_ && offset == next_ && count_ != 0 && count_ != 255;
    }
    void count() {
        message_.bytes[item_ + 1] = ++count_;
        next_ += 8;
    }
    void put_bytes(std::uint64_t value, std::size_t bytes) {
        store_bytes(message_.bytes + message_.size, value, bytes);
        message_.size += bytes;
    }
    void put_distance(std::uint64_t distance) {
        for (; distance > 0x7F; distance >>= 7) { put_bytes((distance & 0x7F) | 0x80, 1); }
        put_bytes(distance, 1);
    }

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
    std::size_t item_ = 0;   // where the present item begins
    std::size_t sizes_ = 0;  // where the numbers of bytes of its newest words are
    unsigned motor_ = 0;
    std::size_t next_ = 0;  // the offset that continues the item
    std::uint8_t count_ = 0;
    std::uint64_t last_ = 0;  // the word before, of words that rise
};

/// Reads a distance of put_rising(). Returns 0, and moves `at` to the end, if the message ends within it.
inline std::uint64_t load_distance(const Message& message, std::size_t& at) {
    std::uint64_t distance = 0;
    for (std::size_t n = 0; n < kMostDistanceBytes && at < message.size; ++n) {
        const std::uint8_t byte = message.bytes[at++];
        distance |= std::uint64_t{byte & 0x7FU} << 7 * n;
        if ((byte & 0x80) == 0) { return distance; }
    }
    at = message.size;
    return 0;
}

/// Calls take(n, value) for the words of an item of words that rise, and moves `at` behind it.
template <typename Take>
void for_each_rising(const Message& message, std::size_t& at, std::size_t count, Take&& take) {
    std::uint64_t value = load_bytes(message.bytes + at, 8);
    at += 8;
    for (std::size_t n = 0; n < count; ++n) {
        const std::uint64_t distance = n == 0 ? 0 : load_distance(message, at);
        if (n != 0 && distance == 0) { return; }
        value += distance;
        take(n, value);
    }
}

/// Calls take(motor, offset, value) for each word of a message, in order. Stops at an item that is not whole.
template <typename Take>
void for_each_word(const Message& message, Take&& take) {
    std::size_t at = kHeaderBytes;
    while (at + kItemBytes <= message.size) {
        const unsigned motor = message.bytes[at];
        const std::size_t count = message.bytes[at + 1];
        const auto first = static_cast<std::size_t>(load_bytes(message.bytes + at + 2, 4));
        at += kItemBytes;
        const bool rises = (motor & kRisingWords) != 0;
        if (rises && at + 8 <= message.size) {
            for_each_rising(message, at, count, [&](std::size_t n, std::uint64_t value) {
                take(motor & ~kRisingWords, (first + n) * 8, value);
            });
            continue;
        }
        if (rises) { return; }
        std::uint8_t sizes = 0;
        for (std::size_t n = 0; n < count; ++n, sizes >>= 4) {
            if (at == message.size && (n % 2 == 0 || (sizes & 15U) != 0)) { return; }
            if (n % 2 == 0) { sizes = message.bytes[at++]; }
            const std::size_t bytes = sizes & 15U;
            if (bytes > 8 || at + bytes > message.size) { return; }
            take(motor, (first + n) * 8, load_signed(message.bytes + at, bytes));
            at += bytes;
        }
    }
}

}  // namespace lockstep::firmware
