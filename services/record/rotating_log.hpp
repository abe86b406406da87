// A log on disk that never becomes larger than it may: files NAME.000001.lcm, NAME.000002.lcm, ..., each an eighth of
// the limit. As one is full the next begins and the oldest goes, whichever process has written it.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <optional>
#include <string>

#include "services/record/record_sink.hpp"
#include "services/wire/lcm_log.hpp"

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
    void flush() override;
    std::uint64_t failures() const override { return failures_; }

private:
    explicit RotatingLog(Place place) : place_(std::move(place)) {}
    std::expected<void, std::string> begin_file();
    bool has_room(std::uint64_t bytes) const;
    bool is_ready(std::int64_t utime, std::uint64_t bytes);
    void give_up_file(std::int64_t utime);
    void remove_oldest() const;

    Place place_;
    std::optional<LogWriter> writer_;  // none: the last one failed
    std::uint64_t written_ = 0;        // bytes of the present file
    std::int64_t retry_utime_ = 0;     // while there is none
    std::int64_t last_utime_ = 0;
    std::uint64_t failures_ = 0;
};

}  // namespace lockstep
