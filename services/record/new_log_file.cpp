#include "services/record/new_log_file.hpp"

#include <unistd.h>

#include <system_error>
#include <utility>

namespace lockstep {
namespace {

bool is_log(const std::filesystem::path& path) {
    auto reader = LogReader::open(path);
    if (!reader) { return false; }
    const auto event = reader->next();
    return event && *event;
}

/// Empty: it may be written. Otherwise what is in the way.
std::string obstacle(const std::filesystem::path& path, bool force) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) { return ""; }
    if (std::filesystem::is_directory(status)) { return "it is a directory; name a file"; }
    if (!std::filesystem::is_regular_file(status)) { return "it is no regular file; name another"; }
    if (force || std::filesystem::file_size(path, error) == 0 || is_log(path)) { return ""; }
    return "the file there is not a log; name another, or say --force to replace it";
}

}  // namespace

NewLogFile::NewLogFile(std::filesystem::path path, std::filesystem::path unfinished, LogWriter writer)
    : path_(std::move(path)), unfinished_(std::move(unfinished)), sink_(std::make_unique<LogSink>(std::move(writer))) {}

NewLogFile::NewLogFile(NewLogFile&& other) noexcept
    : path_(std::move(other.path_)), unfinished_(std::exchange(other.unfinished_, {})), sink_(std::move(other.sink_)) {}

NewLogFile::~NewLogFile() {
    std::error_code ignored;
    if (!unfinished_.empty()) { std::filesystem::remove(unfinished_, ignored); }
}

std::expected<NewLogFile, std::string> NewLogFile::begin(const std::filesystem::path& path, bool force) {
    if (const std::string why_not = obstacle(path, force); !why_not.empty()) {
        return std::unexpected(path.string() + ": " + why_not);
    }
    const std::filesystem::path unfinished = path.string() + ".unfinished-" + std::to_string(::getpid());
    auto writer = LogWriter::open(unfinished);
    if (!writer) { return std::unexpected(writer.error()); }
    return NewLogFile(path, unfinished, std::move(*writer));
}

std::expected<void, std::string> NewLogFile::keep() {
    if (!sink_->finish()) { return std::unexpected(path_.string() + ": cannot be written whole: is the disk full?"); }
    std::error_code error;
    std::filesystem::rename(unfinished_, path_, error);
    if (error) { return std::unexpected(path_.string() + ": cannot be written: " + error.message()); }
    unfinished_.clear();
    return {};
}

}  // namespace lockstep
