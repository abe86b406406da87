// One log to be merged. It is read a little ahead of the merge, so that its messages come out in the order of machine
// time.
//
// A log must be nearly in order: no message may follow one that is more than `window_us` newer. A message that is later
// still comes out late.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "clients/merge/message_id.hpp"
#include "services/record/reading/damage.hpp"
#include "services/wire/lcm/lcm_log.hpp"

namespace lockstep::merge {

struct HeldMessage {
    MessageId id;               // of a foreign channel: the time of the record's message before this one
    std::uint64_t arrival = 0;  // index among the input's messages
    bool is_foreign = false;
    std::vector<std::uint8_t> data;

    friend bool operator<(const HeldMessage& a, const HeldMessage& b) {
        return std::tie(a.id, a.arrival) < std::tie(b.id, b.arrival);
    }
};

class MergeInput {
public:
    /// The error names the file and the reason why it cannot be read.
    static std::expected<MergeInput, std::string> open(const std::filesystem::path& path);

    const std::filesystem::path& path() const { return path_; }
    std::uint64_t file_bytes() const { return file_bytes_; }
    std::uint64_t bytes_read() const { return bytes_read_; }
    std::uint64_t bytes_held() const { return bytes_held_; }
    std::uint64_t messages() const { return messages_; }
    /// One entry per reason. Complete only when the input is at its end.
    const std::vector<analysis::Damage>& damages() const { return damages_; }

    /// Time of the log's first message of the record, nullopt if it has none. The file stays open only from the first
    /// fill() on.
    std::optional<std::int64_t> begins_utime() const { return begins_utime_; }

    /// Reads until the window is full, `most_bytes` are held, or the log ends. Fails if the file cannot be read.
    std::expected<void, std::string> fill(std::int64_t window_us, std::uint64_t most_bytes);
    /// Returns the next message, or null if none is left.
    const HeldMessage* front() const { return held_.empty() ? nullptr : &*held_.begin(); }
    HeldMessage take();

private:
    explicit MergeInput(std::filesystem::path path) : path_(std::move(path)) {}
    std::expected<void, std::string> find_beginning();
    void hold(const LogEvent& event);
    void end();

    std::filesystem::path path_;
    std::uint64_t file_bytes_ = 0;
    std::optional<std::int64_t> begins_utime_;
    std::optional<LogReader> reader_;  // nullopt before the first fill() and at the end
    bool has_ended_ = false;
    std::set<HeldMessage> held_;
    std::uint64_t bytes_held_ = 0;
    std::uint64_t bytes_read_ = 0;
    std::uint64_t messages_ = 0;
    std::int64_t latest_utime_ = 0;  // of the last message of the record that was read
    std::int64_t newest_utime_ = 0;  // the largest of all messages read
    std::vector<analysis::Damage> damages_;
};

}  // namespace lockstep::merge
