// Reads and writes LCM's log files. liblcm's own reader stops silently at the first damaged byte, as if the log ended
// there. This reader continues after the damage and reports what it skipped.
//
// An event is a header of 28 bytes, big endian (sync word 0xEDA1DA01, event number 8, time in us 8, channel length 4,
// data length 4), the channel's name and the data.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "services/wire/lcm/file_window.hpp"

namespace lockstep {

struct LogEvent {
    std::uint64_t offset = 0;  // in the file
    std::uint64_t bytes = 0;   // in the file, with its header
    std::int64_t number = 0;
    std::int64_t utime = 0;  // microseconds, of the logger's clock
    std::string_view channel;
    std::span<const std::uint8_t> data;
};

/// A part of the file that is not a complete event.
struct LogDamage {
    enum class Kind : std::uint8_t {
        CutOff,       // the file ends within an event
        NoEvent,      // no event begins here
        WrongLength,  // an event with a wrong length that includes other events
    };
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
    Kind kind = Kind::NoEvent;
};

class LogReader {
public:
    static constexpr std::uint32_t kMaxChannelBytes = 255;
    static constexpr std::uint32_t kMaxDataBytes = 64 << 20;  // more counts as damage; this limits the memory
    static constexpr std::size_t kMaxDamages = 1000;          // listed; the counts include all

    /// Error: the file's name, and why it cannot be read.
    static std::expected<LogReader, std::string> open(const std::filesystem::path& path);

    /// Returns the next event; nullopt at the end. Its pointers are valid until the next call. Error: reading failed.
    std::expected<std::optional<LogEvent>, std::string> next();
    /// Returns the event that begins at this byte, or the next one after it. next() continues from there.
    std::expected<std::optional<LogEvent>, std::string> event_at(std::uint64_t offset) {
        at_ = offset;
        return next();
    }

    const std::vector<LogDamage>& damages() const { return damages_; }
    std::uint64_t damaged_stretches() const { return damaged_stretches_; }
    std::uint64_t damaged_bytes() const { return damaged_bytes_; }

private:
    struct Header {
        std::int64_t number = 0;
        std::int64_t utime = 0;
        std::uint32_t channel_bytes = 0;
        std::uint32_t data_bytes = 0;
        std::uint64_t event_bytes() const;
    };

    explicit LogReader(FileWindow file) : file_(std::move(file)) {}

    std::optional<Header> header_at(std::uint64_t offset);
    bool begins_event(std::uint64_t offset);
    std::optional<std::uint64_t> find_sync(std::uint64_t from, std::uint64_t to);
    bool hides_another(std::uint64_t offset, std::uint64_t end);
    LogEvent read_event(std::uint64_t offset, const Header& header);
    void skip_damage(LogDamage::Kind kind);

    FileWindow file_;
    std::uint64_t at_ = 0;
    std::vector<LogDamage> damages_;
    std::uint64_t damaged_stretches_ = 0;
    std::uint64_t damaged_bytes_ = 0;
};

class LogWriter {
public:
    /// Begins a new file. Error: the file's name, and why it cannot be written.
    static std::expected<LogWriter, std::string> open(const std::filesystem::path& path);

    /// The size of an event in the file.
    static std::uint64_t event_bytes(std::string_view channel, std::span<const std::uint8_t> data);

    /// Returns false if the disk is full or failed. `utime` is in microseconds.
    bool write(std::string_view channel, std::int64_t utime, std::span<const std::uint8_t> data);

    /// `Message` is a type made by lcm-gen.
    template <typename Message>
    bool write_message(std::string_view channel, std::int64_t utime, const Message& message) {
        buffer_.resize(static_cast<std::size_t>(message.getEncodedSize()));
        message.encode(buffer_.data(), 0, static_cast<int>(buffer_.size()));
        return write(channel, utime, buffer_);
    }

    /// Returns false if the file may be incomplete.
    bool flush() { return static_cast<bool>(file_.flush()); }

private:
    explicit LogWriter(std::ofstream file) : file_(std::move(file)) {}

    std::ofstream file_;
    std::int64_t number_ = 0;
    std::vector<std::uint8_t> buffer_;
};

}  // namespace lockstep
