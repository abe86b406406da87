#include "services/record/disk_room.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <limits>
#include <utility>

namespace lockstep {

DiskRoom::DiskRoom(const std::filesystem::path& file) : file_(open(file.c_str(), O_WRONLY | O_CLOEXEC)) {}

DiskRoom::~DiskRoom() {
    struct stat file {};
    if (fstat(file_.get(), &file) == 0) { (void)!ftruncate(file_.get(), file.st_size); }
}

DiskRoom& DiskRoom::operator=(DiskRoom&& other) noexcept {
    std::swap(file_, other.file_);
    std::swap(taken_, other.taken_);
    return *this;
}

bool DiskRoom::reaches(std::uint64_t bytes) {
    const std::uint64_t least = bytes + kKept;
    return least <= taken_ || take(least + kAhead) || take(least);
}

/// Reserves space without changing the file's size.
bool DiskRoom::take(std::uint64_t bytes) {
    const auto more = static_cast<off_t>(bytes - taken_);
    if (fallocate(file_.get(), FALLOC_FL_KEEP_SIZE, static_cast<off_t>(taken_), more) == 0) {
        taken_ = bytes;
        return true;
    }
    if (errno == ENOSPC || errno == EDQUOT || errno == EFBIG || errno == EINTR) { return false; }
    taken_ = std::numeric_limits<std::uint64_t>::max();
    return true;
}

}  // namespace lockstep
