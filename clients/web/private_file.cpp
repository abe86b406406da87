#include "clients/web/private_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace lockstep::web {

std::expected<void, std::string> make_private_file(const std::filesystem::path& file, const std::string& text) {
    const int made = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, S_IRUSR | S_IWUSR);
    const bool is_written = made >= 0 && write(made, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    const int error = errno;
    if (made >= 0) { close(made); }
    if (is_written) { return {}; }
    return std::unexpected(file.string() + ": cannot be created: " + std::strerror(error));
}

}  // namespace lockstep::web
