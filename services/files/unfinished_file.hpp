// A file in the making: it gets its name when it is whole, so that what breaks off leaves no half of one, and what
// stood there before stays until then.
#pragma once

#include <expected>
#include <filesystem>
#include <string>

namespace lockstep {

class UnfinishedFile {
public:
    /// Nothing is written yet: its maker writes to unfinished().
    explicit UnfinishedFile(const std::filesystem::path& path);
    UnfinishedFile(UnfinishedFile&& other) noexcept;
    UnfinishedFile& operator=(UnfinishedFile&&) = delete;
    /// What was not kept is gone.
    ~UnfinishedFile();

    const std::filesystem::path& path() const { return path_; }
    const std::filesystem::path& unfinished() const { return unfinished_; }
    /// It stands under its name now. Error: the file and the reason.
    std::expected<void, std::string> keep();

private:
    std::filesystem::path path_;
    std::filesystem::path unfinished_;  // empty: nothing to clear away
};

}  // namespace lockstep
