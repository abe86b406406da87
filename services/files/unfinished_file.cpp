#include "services/files/unfinished_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>
#include <utility>

namespace lockstep {

UnfinishedFile::UnfinishedFile(const std::filesystem::path& path)
    : path_(path), unfinished_(fmt::format("{}.unfinished-{}", path.string(), ::getpid())) {}

UnfinishedFile::UnfinishedFile(UnfinishedFile&& other) noexcept
    : path_(std::move(other.path_)), unfinished_(std::exchange(other.unfinished_, {})) {}

UnfinishedFile::~UnfinishedFile() {
    std::error_code ignored;
    if (!unfinished_.empty()) { std::filesystem::remove(unfinished_, ignored); }
}

std::string UnfinishedFile::named(std::string error) const {
    const std::size_t at = error.find(unfinished_.string());
    if (!unfinished_.empty() && at != error.npos) { error.replace(at, unfinished_.string().size(), path_.string()); }
    return error;
}

std::expected<void, std::string> UnfinishedFile::keep() {
    std::error_code error;
    std::filesystem::rename(unfinished_, path_, error);
    if (error) { return std::unexpected(path_.string() + ": cannot be written: " + error.message()); }
    unfinished_.clear();
    return {};
}

}  // namespace lockstep
