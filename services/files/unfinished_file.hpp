// A file that gets its name only when it is complete. Until then a previous file of that name stays. An interrupted
// writer leaves no partial file under that name.
#pragma once

#include <expected>
#include <filesystem>
#include <string>

namespace lockstep {

class UnfinishedFile {
public:
    /// Writes nothing yet; the owner writes to the path unfinished().
    explicit UnfinishedFile(const std::filesystem::path& path);
    UnfinishedFile(UnfinishedFile&& other) noexcept;
    UnfinishedFile& operator=(UnfinishedFile&&) = delete;
    /// Removes the unfinished file unless keep() succeeded.
    ~UnfinishedFile();

    const std::filesystem::path& path() const { return path_; }
    const std::filesystem::path& unfinished() const { return unfinished_; }
    /// The error with the file's name in place of the unfinished file's.
    std::string named(std::string error) const;
    /// Gives the file its name. Error: the file and the reason.
    std::expected<void, std::string> keep();

private:
    std::filesystem::path path_;
    std::filesystem::path unfinished_;  // empty if nothing is to be removed
};

}  // namespace lockstep
