#include "services/files/text_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <istream>

#include "services/files/access.hpp"
#include "services/files/descriptor.hpp"

namespace lockstep {
namespace {

std::unexpected<Diagnostic> refusal(std::string message) {
    return std::unexpected(Diagnostic{.message = std::move(message)});
}

std::unexpected<Diagnostic> unreadable(const std::filesystem::path& path, int error) {
    return refusal("cannot be read: " + why_not_read(path, error));
}

/// Reads up to the end, many bytes at a time. One by one takes far longer.
std::string rest_of(std::istream& stream) {
    constexpr std::size_t kPart_bytes = 1 << 16;
    std::string text;
    while (stream) {
        const std::size_t before = text.size();
        text.resize(before + kPart_bytes);
        stream.read(&text[before], kPart_bytes);
        text.resize(before + static_cast<std::size_t>(stream.gcount()));
    }
    return text;
}

Diagnostic zero_byte(std::string_view text, std::size_t at) {
    const std::string_view before = text.substr(0, at);
    const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
    return {.line = static_cast<int>(std::ranges::count(before, '\n')) + 1,
            .column = static_cast<int>(at - line_begin) + 1,
            .message = "the byte 0x00 is here: the file is not text, or is damaged"};
}

/// Opens the file, writes the text and waits until it is on the disk. Returns false with the reason in errno.
bool write_durably(const std::filesystem::path& path, int flags, mode_t mode, std::string_view text) {
    const Descriptor file(::open(path.c_str(), flags | O_CLOEXEC, mode));
    return write_all(file, text) && ::fsync(file.get()) == 0;
}

}  // namespace

std::expected<std::string, Diagnostic> read_text_file(const std::filesystem::path& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (error == std::errc::permission_denied) { return unreadable(path, error.value()); }
    if (!std::filesystem::exists(status)) { return refusal("there is no such file"); }
    if (std::filesystem::is_directory(status)) { return refusal("this is a directory; name a file in it"); }
    if (!std::filesystem::is_regular_file(status)) { return refusal("this is not a regular file"); }
    const auto size = std::filesystem::file_size(path, error);
    if (!error && size > kMaxTextFileBytes) {
        return refusal(fmt::format("the file has {} bytes, more than {}", size, kMaxTextFileBytes));
    }
    std::ifstream stream(path, std::ios::binary);
    if (!stream) { return unreadable(path, errno); }
    std::string text = rest_of(stream);
    if (stream.bad()) { return unreadable(path, errno); }
    if (text.empty()) { return refusal("the file is empty"); }
    if (const std::size_t zero = text.find('\0'); zero != text.npos) { return std::unexpected(zero_byte(text, zero)); }
    return text;
}

std::expected<void, std::string> write_text_file(const std::filesystem::path& path, std::string_view text) {
    errno = 0;
    std::ofstream out(path, std::ios::binary | std::ios::trunc);
    out << text;
    out.close();
    if (!out) { return std::unexpected(path.string() + ": cannot be written: " + std::strerror(errno)); }
    return {};
}

std::expected<void, std::string> create_text_file(const std::filesystem::path& path, std::string_view text,
                                                  mode_t mode) {
    if (write_durably(path, O_WRONLY | O_CREAT | O_EXCL, mode, text)) { return {}; }
    return std::unexpected(path.string() + ": cannot be written: " + std::strerror(errno));
}

std::expected<void, std::string> replace_text_file(const std::filesystem::path& path, std::string_view text) {
    const std::filesystem::path fresh = fmt::format("{}.new-{}", path.string(), ::getpid());
    const bool is_replaced = write_durably(fresh, O_WRONLY | O_CREAT | O_TRUNC, 0644, text) &&
                             ::rename(fresh.c_str(), path.c_str()) == 0 &&
                             write_durably(path.parent_path(), O_RDONLY | O_DIRECTORY, 0, "");
    if (is_replaced) { return {}; }
    const int why = errno;
    ::unlink(fresh.c_str());
    return std::unexpected(path.string() + ": cannot be written: " + std::strerror(why));
}

}  // namespace lockstep
