#include "clients/web/token_file.hpp"

#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <fstream>

#include "services/files/directories.hpp"
#include "services/files/text_file.hpp"

namespace lockstep::web {
namespace {

constexpr std::size_t kTokenBytes = 16;
constexpr std::size_t kShortestToken = 16;

std::string new_token() {
    std::array<unsigned char, kTokenBytes> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) { return {}; }
    return fmt::format("{:02x}", fmt::join(bytes, ""));
}

std::expected<Tokens, std::string> read_file(const std::filesystem::path& file) {
    std::ifstream stream(file);
    Tokens tokens;
    std::string role;
    std::string token;
    while (stream >> role >> token) { (role == "operate" ? tokens.operate : tokens.view) = token; }
    if (tokens.operate.size() >= kShortestToken && tokens.view.size() >= kShortestToken &&
        tokens.operate != tokens.view) {
        return tokens;
    }
    return std::unexpected(fmt::format(
        "{}: the file must have two lines, 'operate TOKEN' and 'view TOKEN', with two tokens of {} characters or more; "
        "or remove it, and a new one is created",
        file.string(), kShortestToken));
}

std::expected<Tokens, std::string> make_file(const std::filesystem::path& file) {
    Tokens tokens{.view = new_token(), .operate = new_token()};
    if (tokens.view.empty() || tokens.operate.empty()) {
        return std::unexpected("this host provides no random numbers");
    }
    const auto made = create_text_file(file, fmt::format("operate {}\nview {}\n", tokens.operate, tokens.view), 0600);
    if (!made) { return std::unexpected(made.error() + "; name another file: --token-file FILE"); }
    return tokens;
}

}  // namespace

std::expected<Tokens, std::string> tokens_of_file(const std::filesystem::path& file) {
    struct stat status {};
    if (lstat(file.c_str(), &status) != 0) {
        if (auto made = make_own_directory(file.parent_path()); !made) { return std::unexpected(made.error()); }
        return make_file(file);
    }
    const bool is_private = S_ISREG(status.st_mode) && (status.st_mode & (S_IRWXG | S_IRWXO)) == 0;
    if (!is_private || status.st_uid != geteuid()) {
        return std::unexpected(file.string() + ": other users can read it; remove it, and a new one is created");
    }
    return read_file(file);
}

}  // namespace lockstep::web
