// Messages as frames in a stream of bytes: consistent overhead byte stuffing (COBS, Cheshire and Baker 1999).
//
// A frame is a message with its CRC-32, coded without bytes of 0, and a byte of 0 that ends it. So a receiver finds the
// next frame after a damaged one.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lockstep::firmware {

/// With its CRC, a message has at most 254 bytes: COBS then adds one byte.
inline constexpr std::size_t kMostMessageBytes = 250;
inline constexpr std::size_t kMostFrameBytes = kMostMessageBytes + 4 + 2;

struct Message {
    std::uint8_t bytes[kMostMessageBytes + 4];  // with room for the CRC
    std::size_t size = 0;                       // without the CRC
};

struct Frame {
    std::uint8_t bytes[kMostFrameBytes];
    std::size_t size = 0;
};

/// Adds the CRC behind the message.
void encode(Message& message, Frame& frame);

class FrameReader {
public:
    /// Returns true if this byte ends a frame whose CRC is right. Its message then remains until the next call.
    bool take(std::uint8_t byte);
    const Message& message() const { return message_; }
    /// Frames that were too long, too short, or had another CRC.
    std::uint32_t refused() const { return refused_; }

private:
    bool end();
    bool is_right() const;
    void put(std::uint8_t byte);

    Message message_;
    std::size_t size_ = 0;     // of the message in progress, with its CRC
    std::uint8_t run_ = 0;     // bytes until the next 0 of the message
    bool is_full_run_ = true;  // no 0 follows this run
    bool is_too_long_ = false;
    std::uint32_t refused_ = 0;
};

}  // namespace lockstep::firmware
