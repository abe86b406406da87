#include "services/network/lcm_url.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>

#include "core/parse_number.hpp"

namespace lockstep {
namespace {

template <typename Number>
std::expected<Number, std::string> number(std::string_view text, std::string_view what, Number most) {
    const auto value = parse_number<Number>(text);
    if (value && *value >= 0 && *value <= most) { return *value; }
    return std::unexpected(fmt::format("the LCM URL's {} is '{}'; it must be a number from 0 to {}", what, text, most));
}

bool is_multicast_address(const std::string& address) {
    in_addr parsed{};
    return inet_pton(AF_INET, address.c_str(), &parsed) == 1 && (ntohl(parsed.s_addr) >> 28) == 0xE;
}

/// Returns the part before the separator; `text` keeps the part after it.
std::string_view cut(std::string_view& text, std::string_view separator) {
    const std::size_t at = text.find(separator);
    const std::string_view before = text.substr(0, at);
    text = at == text.npos ? std::string_view{} : text.substr(at + separator.size());
    return before;
}

std::expected<void, std::string> read_place(std::string_view place, LcmUrl& url) {
    const std::string_view address = cut(place, ":");
    if (!address.empty()) { url.address = address; }
    if (!is_multicast_address(url.address)) {
        return std::unexpected("the LCM URL's address '" + url.address + "' is not an IPv4 multicast address");
    }
    if (place.empty()) { return {}; }
    const auto port = number<int>(place, "port", 65535);
    if (!port) { return std::unexpected(port.error()); }
    url.port = static_cast<std::uint16_t>(*port);
    return {};
}

}  // namespace

std::expected<LcmUrl, std::string> parse_lcm_url(std::string_view text) {
    LcmUrl url;
    if (text.empty()) { return url; }
    url.provider = cut(text, "://");
    if (!url.is_multicast()) { return url; }
    if (const auto read = read_place(cut(text, "?"), url); !read) { return std::unexpected(read.error()); }
    while (!text.empty()) {
        std::string_view option = cut(text, "&");
        if (cut(option, "=") != "ttl") { continue; }
        const auto ttl = number<int>(option, "ttl", 255);
        if (!ttl) { return std::unexpected(ttl.error()); }
        url.ttl = *ttl;
    }
    return url;
}

}  // namespace lockstep
