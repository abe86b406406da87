#include "sim_fpga/firmware/link/frame.hpp"

#include "sim_fpga/firmware/link/crc32.hpp"

namespace lockstep::firmware {
namespace {

constexpr std::size_t kCrcBytes = 4;
constexpr std::uint8_t kLongestRun = 255;

}  // namespace

void encode(Message& message, Frame& frame) {
    const std::uint32_t crc = crc32(message.bytes, message.size);
    for (std::size_t n = 0; n < kCrcBytes; ++n) {
        message.bytes[message.size + n] = static_cast<std::uint8_t>(crc >> 8 * n);
    }
    std::size_t code = 0;  // the place of the present run's length
    frame.size = 1;
    for (std::size_t n = 0; n < message.size + kCrcBytes; ++n) {
        if (message.bytes[n] == 0) {
            frame.bytes[code] = static_cast<std::uint8_t>(frame.size - code);
            code = frame.size++;
        } else {
            frame.bytes[frame.size++] = message.bytes[n];
        }
    }
    frame.bytes[code] = static_cast<std::uint8_t>(frame.size - code);
    frame.bytes[frame.size++] = 0;
}

bool FrameReader::take(std::uint8_t byte) {
    if (byte == 0) { return end(); }
    if (run_ > 0) {
        --run_;
        put(byte);
        return false;
    }
    if (!is_full_run_) { put(0); }
    run_ = static_cast<std::uint8_t>(byte - 1);
    is_full_run_ = byte == kLongestRun;
    return false;
}

void FrameReader::put(std::uint8_t byte) {
    if (size_ == sizeof message_.bytes) {
        is_too_long_ = true;
        return;
    }
    message_.bytes[size_++] = byte;
}

bool FrameReader::end() {
    const bool is_empty = size_ == 0 && run_ == 0;
    const bool is_good = is_right();
    if (!is_good && !is_empty) { ++refused_; }
    message_.size = is_good ? size_ - kCrcBytes : 0;
    size_ = 0;
    run_ = 0;
    is_full_run_ = true;
    is_too_long_ = false;
    return is_good;
}

bool FrameReader::is_right() const {
    if (run_ != 0 || is_too_long_ || size_ < kCrcBytes) { return false; }
    const std::size_t end = size_ - kCrcBytes;
    std::uint32_t crc = 0;
    for (std::size_t n = 0; n < kCrcBytes; ++n) { crc |= std::uint32_t{message_.bytes[end + n]} << 8 * n; }
    return crc == crc32(message_.bytes, end);
}

}  // namespace lockstep::firmware
