// A log on disk with a maximum size. It has files NAME.000001.lcm, NAME.000002.lcm, ..., each of at most an eighth of
// the limit. When one is full, it begins the next and removes the oldest, even if another process wrote that. The file
// in progress reserves some space, so that losses can be recorded on a full disk.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <optional>
#include <string>

#include "services/record/disk_room.hpp"
#include "services/record/record_sink.hpp"
#include "services/wire/lcm/lcm_log.hpp"

namespace lockstep {

class RotatingLog final : public RecordSink {
public:
    static constexpr std::uint64_t kFiles = 8;
    static constexpr std::int64_t kRetry_us = 10'000'000;  // after a failed write, e.g. on a full disk

    struct Place {
        std::filesystem::path directory;
        std::string name;  // name of the writing process
        std::uint64_t limit_bytes = 0;
    };

    /// Creates the directory, and a new file with the next number. Error: why it cannot.
    static std::expected<RotatingLog, std::string> open(Place place);

    void write(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) override;
    void write_kept(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) override;
    void flush() override;
    std::uint64_t failures() const override { return failures_; }

private:
    explicit RotatingLog(Place place) : place_(std::move(place)) {}
    struct File {
        DiskRoom room;  // destroyed after the writer, which has then written everything
        LogWriter writer;
        std::uint64_t written = 0;  // bytes so far
    };

    std::expected<File, std::string> new_file() const;
    bool begin_file();
    void put(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes);
    bool has_room(std::uint64_t bytes) const;
    bool is_ready(std::int64_t utime, std::uint64_t bytes);
    void give_up_file(std::int64_t utime);
    void remove_oldest() const;

    Place place_;
    std::optional<File> file_;      // nullopt: the last one failed
    std::int64_t retry_utime_ = 0;  // no new file before this time
    std::int64_t last_utime_ = 0;
    std::uint64_t failures_ = 0;
};

}  // namespace lockstep
