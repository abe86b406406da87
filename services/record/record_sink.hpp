// The destination of the record: the network, a log file, or both.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lockstep {

class RecordSink {
public:
    /// publish() allocates nothing for messages of at most this size. The largest message of steps needs 10 KB: an axis
    /// that was stalled publishes it in its loop.
    static constexpr std::size_t kReservedMessage_bytes = 16 << 10;

    RecordSink() { buffer_.reserve(kReservedMessage_bytes); }
    virtual ~RecordSink() = default;
    /// `utime` is machine time in microseconds. A message that cannot be written is only counted; motion never waits
    /// for it.
    virtual void write(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) = 0;
    /// Writes into reserved space, even if nothing else can be written.
    virtual void write_kept(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) {
        write(channel, utime, bytes);
    }
    /// Writes all data buffered in memory.
    virtual void flush() {}
    /// Messages that could not be written.
    virtual std::uint64_t failures() const { return 0; }

    /// `Message` is a type made by lcm-gen.
    template <typename Message>
    void publish(const std::string& channel, const Message& message) {
        buffer_.resize(static_cast<std::size_t>(message.getEncodedSize()));
        message.encode(buffer_.data(), 0, static_cast<int>(buffer_.size()));
        write(channel, message.utime, buffer_);
    }

private:
    std::vector<std::uint8_t> buffer_;
};

}  // namespace lockstep
