// A file under construction: it gets its name when it is complete. An interrupted writer leaves no partial file. The
// previous file stays until then.
#pragma once

#include <expected>
#include <filesystem>
#include <string>

namespace lockstep {

class UnfinishedFile {
public:
    /// Writes nothing yet: the owner writes to unfinished().
    explicit UnfinishedFile(const std::filesystem::path& path);
    UnfinishedFile(UnfinishedFile&& other) noexcept;
    UnfinishedFile& operator=(UnfinishedFile&&) = delete;
    /// Removes the file if it was not kept.
    ~UnfinishedFile();

    const std::filesystem::path& path() const { return path_; }
    const std::filesystem::path& unfinished() const { return unfinished_; }
    /// Gives the file its name. Error: the file and the reason.
    std::expected<void, std::string> keep();

private:
    std::filesystem::path path_;
    std::filesystem::path unfinished_;  // empty: nothing to remove
};

}  // namespace lockstep
