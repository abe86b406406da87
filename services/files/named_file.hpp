// A file that is open, and the name under which it was found.
#pragma once

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <expected>
#include <filesystem>
#include <string>

namespace lockstep {

/// What could not be done with it, and why, as errno has it.
inline std::unexpected<std::string> cannot(const std::string& file, const char* action) {
    return std::unexpected(file + ": cannot " + action + ": " + std::strerror(errno));
}

/// The name's file and the one that is open are the same: nobody has removed or replaced it meanwhile.
inline bool is_still_named(const std::filesystem::path& path, int file) {
    struct stat open_one {};
    struct stat named {};
    return fstat(file, &open_one) == 0 && stat(path.c_str(), &named) == 0 && open_one.st_ino == named.st_ino;
}

}  // namespace lockstep
