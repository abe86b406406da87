// Room on a disk for a file that grows, taken before it is written. So a full disk is noticed while there is still some
// room left in the file, in which it can be said what is lost.
#pragma once

#include <cstdint>
#include <filesystem>

namespace lockstep {

class DiskRoom {
public:
    static constexpr std::uint64_t kAhead = 16 << 10;  // taken at a time
    static constexpr std::uint64_t kKept = 16 << 10;   // for what must be said

    /// The file is there. Where the file system cannot take room in advance there is none to keep.
    explicit DiskRoom(const std::filesystem::path& file);
    /// Gives back what the file has not grown into.
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
