#include "services/record/new_log_file.hpp"

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

/// Returns why the file must not be written; empty if it may be written.
std::string obstacle(const std::filesystem::path& path, bool force) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) { return ""; }
    if (std::filesystem::is_directory(status)) { return "it is a directory; name a file"; }
    if (!std::filesystem::is_regular_file(status)) { return "it is not a regular file; name another file"; }
    if (force || std::filesystem::file_size(path, error) == 0 || is_log(path)) { return ""; }
    return "the existing file is not a log; name another file, or add --force to replace it";
}

}  // namespace

NewLogFile::NewLogFile(UnfinishedFile file, LogWriter writer)
    : file_(std::move(file)), sink_(std::make_unique<LogSink>(std::move(writer))) {}

std::expected<NewLogFile, std::string> NewLogFile::begin(const std::filesystem::path& path, bool force) {
    if (const std::string why_not = obstacle(path, force); !why_not.empty()) {
        return std::unexpected(path.string() + ": " + why_not);
    }
    UnfinishedFile file(path);
    auto writer = LogWriter::open(file.unfinished());
    if (!writer) { return std::unexpected(writer.error()); }
    return NewLogFile(std::move(file), std::move(*writer));
}

std::expected<void, std::string> NewLogFile::keep() {
    if (!sink_->finish()) {
        return std::unexpected(file_.path().string() +
                               ": cannot be written completely; check whether the disk is full");
    }
    return file_.keep();
}

}  // namespace lockstep
