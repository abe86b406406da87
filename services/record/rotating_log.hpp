// A log on disk that never becomes larger than it may: files NAME.000001.lcm, NAME.000002.lcm, ..., each an eighth of
// the limit. As one is full the next begins and the oldest goes, whichever process has written it. On a full disk the
// file in progress keeps a little room, for what is lost to be said.
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
    static constexpr std::int64_t kRetry_us = 10'000'000;  // after what could not be written, as by a full disk

    struct Place {
        std::filesystem::path directory;
        std::string name;  // of who writes it
        std::uint64_t limit_bytes = 0;
    };

    /// Makes the directory, and a new file behind those that are there. Error: why not, and the remedy.
    static std::expected<RotatingLog, std::string> open(Place place);

    void write(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) override;
    void write_kept(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) override;
    void flush() override;
    std::uint64_t failures() const override { return failures_; }

private:
    explicit RotatingLog(Place place) : place_(std::move(place)) {}
    struct File {
        DiskRoom room;  // given back when the writer has written all
        LogWriter writer;
        std::uint64_t written = 0;  // bytes
    };

    std::expected<File, std::string> new_file() const;
    bool begin_file();
    void put(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes);
    bool has_room(std::uint64_t bytes) const;
    bool is_ready(std::int64_t utime, std::uint64_t bytes);
    void give_up_file(std::int64_t utime);
    void remove_oldest() const;

    Place place_;
    std::optional<File> file_;      // none: the last one failed
    std::int64_t retry_utime_ = 0;  // no new file is begun before
    std::int64_t last_utime_ = 0;
    std::uint64_t failures_ = 0;
};

}  // namespace lockstep
