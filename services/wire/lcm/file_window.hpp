// Gives access to any part of a file without holding the whole file in memory.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace lockstep {

class FileWindow {
public:
    static constexpr std::size_t kWindowBytes = 1 << 20;

    /// Error: the file's name, and why it cannot be read. size() stays the file's size at this time.
    static std::expected<FileWindow, std::string> open(const std::filesystem::path& path);

    std::uint64_t size() const { return size_; }

    /// Returns `count` bytes from `offset` on, or the rest of the file. Valid until the next call. Empty, with failed()
    /// true, if reading failed.
    std::span<const std::uint8_t> view(std::uint64_t offset, std::size_t count);

    bool failed() const { return failed_; }

private:
    FileWindow(std::ifstream file, std::uint64_t size) : file_(std::move(file)), size_(size) {}
    void load(std::uint64_t offset, std::size_t count);

    std::ifstream file_;
    std::uint64_t size_;
    std::uint64_t start_ = 0;  // the window's offset in the file
    std::vector<std::uint8_t> window_;
    bool failed_ = false;
};

}  // namespace lockstep
