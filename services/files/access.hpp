// Why this user may not read a file, and how to get the right.
#pragma once

#include <filesystem>
#include <string>

namespace lockstep {

/// Why a file or directory cannot be read, from the error number of the attempt. If this user lacks the right, names
/// the directory on the way that this user may not enter, or the file, and the group to join: "this user may not enter
/// the directory /etc/lockstep; its group lockstep may: as root, adduser ann lockstep, then log in again".
std::string why_not_read(const std::filesystem::path& path, int error);

}  // namespace lockstep
