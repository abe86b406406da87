// How a host reaches a board: the key `link` of a board in the machine's file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lockstep {

struct LinkName {
    enum class Kind : std::uint8_t {
        Serial,  // "serial:PATH": a serial line, or a USB cable that is one for the host, by its absolute path
        Tcp,     // "tcp:ADDRESS:PORT": for tests and emulated boards
    };
    Kind kind = Kind::Serial;
    std::string place;       // PATH, or ADDRESS: four numbers
    std::uint16_t port = 0;  // of Tcp

    /// As in the machine's file.
    std::string text() const;
    bool operator==(const LinkName&) const = default;
};

inline constexpr std::string_view kLinkNames = "serial:PATH or tcp:ADDRESS:PORT";
/// Returns nullopt if the text is none of kLinkNames.
std::optional<LinkName> read_link_name(std::string_view text);

}  // namespace lockstep
