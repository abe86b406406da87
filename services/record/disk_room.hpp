// Reserves disk space for a growing file before the file needs it. So the writer notices a full disk while the file
// still has room to record losses.
#pragma once

#include <cstdint>
#include <filesystem>

#include "services/files/descriptor.hpp"

namespace lockstep {

class DiskRoom {
public:
    static constexpr std::uint64_t kAhead = 16 << 10;  // reserved in one step
    static constexpr std::uint64_t kKept = 16 << 10;   // reserved for loss messages

    /// `file` must exist. If the file system cannot reserve space, nothing is reserved.
    explicit DiskRoom(const std::filesystem::path& file);
    /// Releases the space that the file did not use.
    ~DiskRoom();
    DiskRoom(DiskRoom&& other) = default;
    DiskRoom& operator=(DiskRoom&& other) noexcept;

    /// Returns whether the file may grow to `bytes` and kKept more.
    bool reaches(std::uint64_t bytes);

private:
    bool take(std::uint64_t bytes);

    Descriptor file_;
    std::uint64_t taken_ = 0;
};

}  // namespace lockstep
