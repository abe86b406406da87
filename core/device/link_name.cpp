#include "core/device/link_name.hpp"

#include <algorithm>
#include <charconv>

namespace lockstep {
namespace {

constexpr std::string_view kSerial = "serial:";
constexpr std::string_view kTcp = "tcp:";
constexpr std::string_view kSpi = "spi:";

bool is_address(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
}

/// ADDRESS:PORT
std::optional<LinkName> read_tcp(std::string_view text) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::string_view port = text.substr(std::min(text.size(), colon + 1));
    LinkName link{LinkName::Kind::Tcp, std::string(text.substr(0, colon))};
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), link.port);
    const bool is_port = error == std::errc() && end == port.data() + port.size() && link.port != 0;
    return is_port && is_address(link.place) ? std::optional(link) : std::nullopt;
}

bool is_path(std::string_view text) { return text.size() >= 2 && text.front() == '/'; }

/// PATH or PATH@HZ
std::optional<LinkName> read_spi(std::string_view text) {
    const std::size_t at = std::min(text.find('@'), text.size());
    LinkName link{LinkName::Kind::Spi, std::string(text.substr(0, at))};
    link.speed_hz = LinkName::kSpiSpeed_hz;
    if (!is_path(link.place)) { return std::nullopt; }
    if (at == text.size()) { return link; }
    const auto [end, error] = std::from_chars(text.data() + at + 1, text.data() + text.size(), link.speed_hz);
    const bool is_speed = error == std::errc() && end == text.data() + text.size() && link.speed_hz != 0;
    return is_speed ? std::optional(link) : std::nullopt;
}

}  // namespace

std::string LinkName::text() const {
    switch (kind) {
        case Kind::Serial: break;
        case Kind::Spi: {
            const bool is_usual = speed_hz == kSpiSpeed_hz;
            return std::string(kSpi) + place + (is_usual ? "" : "@" + std::to_string(speed_hz));
        }
        case Kind::Tcp: return std::string(kTcp) + place + ":" + std::to_string(port);
    }
    return std::string(kSerial) + place;
}

std::optional<LinkName> read_link_name(std::string_view text) {
    if (text.starts_with(kTcp)) { return read_tcp(text.substr(kTcp.size())); }
    if (text.starts_with(kSpi)) { return read_spi(text.substr(kSpi.size())); }
    if (!text.starts_with(kSerial)) { return std::nullopt; }
    const std::string_view path = text.substr(kSerial.size());
    if (!is_path(path)) { return std::nullopt; }
    return LinkName{LinkName::Kind::Serial, std::string(path)};
}

}  // namespace lockstep
