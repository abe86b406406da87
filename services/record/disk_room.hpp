// Reserves disk space for a growing file before it is written. So a full disk is noticed while the file still has room
// to record what is lost.
#pragma once

#include <cstdint>
#include <filesystem>

namespace lockstep {

class DiskRoom {
public:
    static constexpr std::uint64_t kAhead = 16 << 10;  // reserved at a time
    static constexpr std::uint64_t kKept = 16 << 10;   // for the loss messages

    /// The file exists. If the file system cannot reserve space in advance, nothing is reserved.
    explicit DiskRoom(const std::filesystem::path& file);
    /// Releases the space that the file did not use.
    ~DiskRoom();
    DiskRoom(DiskRoom&& other) noexcept;
    DiskRoom& operator=(DiskRoom&& other) noexcept;

    /// True: the file may grow to so many bytes, and kKept more.
    bool reaches(std::uint64_t bytes);

private:
    bool take(std::uint64_t bytes);

    int file_ = -1;
    std::uint64_t taken_ = 0;
};

}  // namespace lockstep
