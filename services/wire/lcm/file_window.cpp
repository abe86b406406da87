#include "services/wire/lcm/file_window.hpp"

#include <algorithm>
#include <cerrno>

#include "services/files/access.hpp"

namespace lockstep {

std::expected<FileWindow, std::string> FileWindow::open(const std::filesystem::path& path) {
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (error) { return std::unexpected("cannot read " + path.string() + ": " + why_not_read(path, error.value())); }
    std::ifstream file(path, std::ios::binary);
    if (!file) { return std::unexpected("cannot read " + path.string() + ": " + why_not_read(path, errno)); }
    return FileWindow(std::move(file), size);
}

std::span<const std::uint8_t> FileWindow::view(std::uint64_t offset, std::size_t count) {
    if (offset >= size_) { return {}; }
    count = static_cast<std::size_t>(std::min<std::uint64_t>(count, size_ - offset));
    if (offset < start_ || offset + count > start_ + window_.size()) { load(offset, std::max(count, kWindowBytes)); }
    if (failed_) { return {}; }
    return std::span<const std::uint8_t>(window_).subspan(offset - start_, count);
}

void FileWindow::load(std::uint64_t offset, std::size_t count) {
    start_ = offset;
    window_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(count, size_ - offset)));
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(offset));
    file_.read(reinterpret_cast<char*>(window_.data()), static_cast<std::streamsize>(window_.size()));
    failed_ = failed_ || !file_;
}

}  // namespace lockstep
