#include "services/record/rotating_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <vector>

#include "core/parse_number.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

struct NumberedFile {
    std::uint64_t number = 0;
    fs::path path;
    std::uint64_t bytes = 0;
};

/// Returns the number in NAME.NUMBER.lcm.
std::optional<std::uint64_t> number_in(const std::string& file, const std::string& name) {
    constexpr std::string_view kEnd = ".lcm";
    const std::string begin = name + ".";
    if (file.size() < begin.size() + kEnd.size() || !file.starts_with(begin) || !file.ends_with(kEnd)) {
        return std::nullopt;
    }
    return parse_number<std::uint64_t>(
        std::string_view(file).substr(begin.size(), file.size() - begin.size() - kEnd.size()));
}

/// Returns the files of the log, oldest first.
std::vector<NumberedFile> files_of(const RotatingLog::Place& place) {
    std::vector<NumberedFile> files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(place.directory, error)) {
        const auto number = number_in(entry.path().filename().string(), place.name);
        std::error_code gone;
        const std::uint64_t bytes = number ? entry.file_size(gone) : 0;
        if (number && !gone) { files.push_back({*number, entry.path(), bytes}); }
    }
    std::ranges::sort(files, {}, &NumberedFile::number);
    return files;
}

std::string file_name(const std::string& name, std::uint64_t number) {
    return fmt::format("{}.{:06}.lcm", name, number);
}

/// Claims the first free name from `number` on, because a coordinator and its standby use the same names. If no file
/// can be created, the later opening reports why.
fs::path claim_file(const RotatingLog::Place& place, std::uint64_t number) {
    constexpr std::uint64_t kMostRivals = 100;
    fs::path path;
    for (const std::uint64_t last = number + kMostRivals; number < last; ++number) {
        path = place.directory / file_name(place.name, number);
        std::FILE* const claimed = std::fopen(path.c_str(), "wx");
        const bool is_taken = claimed == nullptr && errno == EEXIST;
        if (claimed != nullptr) { std::fclose(claimed); }
        if (!is_taken) { break; }
    }
    return path;
}

}  // namespace

std::expected<RotatingLog, std::string> RotatingLog::open(Place place) {
    std::error_code error;
    fs::create_directories(place.directory, error);
    if (error) { return std::unexpected("cannot create " + place.directory.string() + ": " + error.message()); }
    RotatingLog log(std::move(place));
    auto file = log.new_file();
    if (!file) { return std::unexpected(file.error()); }
    log.file_ = std::move(*file);
    return log;
}

std::expected<RotatingLog::File, std::string> RotatingLog::new_file() const {
    remove_oldest();
    const auto files = files_of(place_);
    const fs::path path = claim_file(place_, files.empty() ? 1 : files.back().number + 1);
    auto writer = LogWriter::open(path);
    if (!writer) { return std::unexpected(writer.error()); }
    File file{DiskRoom(path), std::move(*writer)};
    if (file_ && !file.room.reaches(0)) {  // keeps the previous file, which has room for loss messages
        std::error_code ignored;
        fs::remove(path, ignored);
        return std::unexpected("the disk is full");
    }
    (void)file.room.reaches(0);
    return file;
}

bool RotatingLog::begin_file() {
    flush();
    auto file = new_file();
    if (!file) { return false; }
    file_ = std::move(*file);
    return true;
}

/// Removes the oldest files until a new one has room. Even an empty file, of a process that ended early, counts as
/// kLeastBytes, otherwise the number of files would be unbounded.
void RotatingLog::remove_oldest() const {
    constexpr std::uint64_t kLeastBytes = 4096;
    const std::uint64_t room = place_.limit_bytes - place_.limit_bytes / kFiles;
    auto files = files_of(place_);
    std::uint64_t total = 0;
    for (const NumberedFile& file : files) { total += std::max(file.bytes, kLeastBytes); }
    for (auto file = files.begin(); file != files.end() && total > room; ++file) {
        std::error_code ignored;
        fs::remove(file->path, ignored);
        total -= std::max(file->bytes, kLeastBytes);
    }
}

/// A message larger than a file's limit gets its own file.
bool RotatingLog::has_room(std::uint64_t bytes) const {
    return file_->written == 0 || file_->written + bytes <= place_.limit_bytes / kFiles;
}

bool RotatingLog::is_ready(std::int64_t utime, std::uint64_t bytes) {
    if (!file_ || !has_room(bytes)) {
        if (utime < retry_utime_) { return false; }
        if (!begin_file()) {
            retry_utime_ = utime + kRetry_us;
            return false;
        }
    }
    return file_->room.reaches(file_->written + bytes);
}

void RotatingLog::give_up_file(std::int64_t utime) {
    file_.reset();
    retry_utime_ = utime + kRetry_us;
}

void RotatingLog::put(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) {
    if (file_->writer.write(channel, utime, bytes)) {
        file_->written += LogWriter::event_bytes(channel, bytes);
        return;
    }
    ++failures_;
    give_up_file(utime);
}

void RotatingLog::write(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) {
    last_utime_ = utime;
    is_ready(utime, LogWriter::event_bytes(channel, bytes)) ? put(channel, utime, bytes) : void(++failures_);
}

void RotatingLog::write_kept(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) {
    file_ ? put(channel, utime, bytes) : void(++failures_);
}

/// A failed flush may lose several messages but counts as one failure. The file's end shows the gap.
void RotatingLog::flush() {
    if (!file_ || file_->writer.flush()) { return; }
    ++failures_;
    give_up_file(last_utime_);
}

}  // namespace lockstep
