// A file that is written part by part. After a failed write it ignores further ones, and close() returns the reason.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <string>
#include <string_view>

#include "services/files/descriptor.hpp"

namespace lockstep {

class OutputFile {
public:
    /// Creates the file, or replaces its content. The error names the file and the reason.
    static std::expected<OutputFile, std::string> create(const std::filesystem::path& path);

    /// Does not buffer, so write large parts.
    void write(std::string_view bytes);
    /// Bytes passed to write().
    std::uint64_t size() const { return size_; }
    bool is_written() const { return failure_ == 0; }
    /// Call once, at the end. The error names the file and the reason of the first failure, such as a full disk.
    std::expected<void, std::string> close();

private:
    OutputFile(std::filesystem::path path, Descriptor file) : path_(std::move(path)), file_(std::move(file)) {}

    std::filesystem::path path_;
    Descriptor file_;
    std::uint64_t size_ = 0;
    int failure_ = 0;  // errno of the first failed write
};

}  // namespace lockstep
