// An open file, and the path under which it was found.
#pragma once

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <expected>
#include <filesystem>
#include <string>

namespace lockstep {

/// Returns the error of a failed action, with the reason from errno.
inline std::unexpected<std::string> cannot(const std::string& file, const char* action) {
    return std::unexpected(file + ": cannot " + action + ": " + std::strerror(errno));
}

/// Whether the path still names the open file, which means that the file was not removed or replaced.
inline bool is_still_named(const std::filesystem::path& path, int file) {
    struct stat open_one {};
    struct stat named {};
    return fstat(file, &open_one) == 0 && stat(path.c_str(), &named) == 0 && open_one.st_ino == named.st_ino;
}

}  // namespace lockstep
