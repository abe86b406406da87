#include "clients/session/lease/login_writer.hpp"

#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

#include "services/network/host_name.hpp"

namespace lockstep {
namespace {

std::string login_name() {
    if (const char* name = std::getenv("LOCKSTEP_WRITER"); name != nullptr && *name != '\0') { return name; }
    std::array<char, 4096> text{};
    passwd entry{};
    passwd* found = nullptr;
    const bool is_read = getpwuid_r(getuid(), &entry, text.data(), text.size(), &found) == 0;
    return is_read && found != nullptr ? entry.pw_name : fmt::format("user {}", getuid());
}

/// Replaces control characters, because other people's terminals show the text.
std::string printable(std::string text) {
    for (char& character : text) {
        const auto byte = static_cast<unsigned char>(character);
        if (byte < 0x20 || byte == 0x7F || byte == 0xC2) { character = '?'; }
    }
    return text;
}

/// FNV-1a.
std::uint64_t hash_of(const std::string& text) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char character : text) { hash = (hash ^ static_cast<unsigned char>(character)) * 0x100000001b3U; }
    return hash;
}

}  // namespace

LeaseHolder writer_of(const std::string& name, const std::string& host) {
    return {.id = hash_of(name + '\n' + host) | 1, .name = printable(name), .host = printable(host)};
}

LeaseHolder named_writer(const std::string& value, const std::string& host) {
    const std::size_t at = value.rfind('@');
    const bool names_host = at != value.npos && at > 0 && at + 1 < value.size();
    return names_host ? writer_of(value.substr(0, at), value.substr(at + 1)) : writer_of(value, host);
}

LeaseHolder login_writer() { return named_writer(login_name(), host_name()); }

}  // namespace lockstep
