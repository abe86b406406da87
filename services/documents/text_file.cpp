#include "services/documents/text_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace lockstep {
namespace {

std::unexpected<Diagnostic> refusal(std::string message) {
    return std::unexpected(Diagnostic{.message = std::move(message)});
}

}  // namespace

std::expected<std::string, Diagnostic> read_text_file(const std::filesystem::path& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) { return refusal("there is no such file, or its folder cannot be read"); }
    if (std::filesystem::is_directory(status)) { return refusal("this is a directory; name a file in it"); }
    if (!std::filesystem::is_regular_file(status)) { return refusal("this is not a regular file"); }
    const auto size = std::filesystem::file_size(path, error);
    if (!error && size > kMaxTextFileBytes) {
        return refusal("the file has " + std::to_string(size) + " bytes, more than " +
                       std::to_string(kMaxTextFileBytes));
    }
    std::ifstream stream(path, std::ios::binary);
    if (!stream) { return refusal(std::string("cannot be read: ") + std::strerror(errno)); }
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (stream.bad()) { return refusal(std::string("cannot be read: ") + std::strerror(errno)); }
    if (text.empty()) { return refusal("the file is empty"); }
    if (text.find('\0') != std::string::npos) { return refusal("the file holds 0 bytes; it is not text"); }
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

}  // namespace lockstep
