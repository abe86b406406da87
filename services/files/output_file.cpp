#include "services/files/output_file.hpp"

#include <fcntl.h>

#include <cerrno>
#include <cstring>

namespace lockstep {

std::expected<OutputFile, std::string> OutputFile::create(const std::filesystem::path& path) {
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (!file.is_open()) { return std::unexpected(path.string() + ": cannot be written: " + std::strerror(errno)); }
    return OutputFile(path, std::move(file));
}

void OutputFile::write(std::string_view bytes) {
    size_ += bytes.size();
    if (is_written() && !write_all(file_, bytes)) { failure_ = errno; }
}

std::expected<void, std::string> OutputFile::close() {
    if (::close(file_.release()) != 0 && is_written()) { failure_ = errno; }
    if (is_written()) { return {}; }
    return std::unexpected(path_.string() + ": not written completely: " + std::strerror(failure_));
}

}  // namespace lockstep
