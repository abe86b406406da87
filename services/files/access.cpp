#include "services/files/access.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace lockstep {
namespace {

std::string user_name(uid_t user) {
    const passwd* entry = getpwuid(user);
    return entry != nullptr ? entry->pw_name : fmt::format("{}", user);
}

std::string group_name(gid_t group) {
    const struct group* entry = getgrgid(group);
    return entry != nullptr ? entry->gr_name : fmt::format("{}", group);
}

std::string how_to_get_the_right(const std::filesystem::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) { return "see: ls -ld " + path.string(); }
    const mode_t right = S_ISDIR(status.st_mode) ? S_IXGRP : S_IRGRP;
    if ((status.st_mode & right) == 0 || status.st_gid == 0) {
        return fmt::format("only its owner {} may", user_name(status.st_uid));
    }
    const std::string group = group_name(status.st_gid);
    return fmt::format("its group {0} may: as root, adduser {1} {0}, then log in again", group, user_name(geteuid()));
}

bool may_enter(const std::filesystem::path& directory) {
    return faccessat(AT_FDCWD, directory.c_str(), X_OK, AT_EACCESS) == 0;
}

}  // namespace

std::string why_not_read(const std::filesystem::path& path, int error) {
    if (error != EACCES) { return std::strerror(error); }
    std::filesystem::path directory;
    for (const std::filesystem::path& part : std::filesystem::absolute(path).parent_path()) {
        directory /= part;
        if (!may_enter(directory)) {
            return fmt::format("this user may not enter the directory {}; {}", directory.string(),
                               how_to_get_the_right(directory));
        }
    }
    return "this user may not read it; " + how_to_get_the_right(path);
}

}  // namespace lockstep
