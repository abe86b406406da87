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
        Spi,     // "spi:PATH" or "spi:PATH@HZ": an SPI device of Linux, and its speed
    };
    Kind kind = Kind::Serial;
    std::string place;           // PATH, or ADDRESS: four numbers
    std::uint16_t port = 0;      // of Tcp
    std::uint32_t speed_hz = 0;  // of Spi

    /// The speed of an SPI whose link names none. Every design works at it.
    static constexpr std::uint32_t kSpiSpeed_hz = 5'000'000;

    /// As in the machine's file.
    std::string text() const;
    bool operator==(const LinkName&) const = default;
};

inline constexpr std::string_view kLinkNames = "serial:PATH, spi:PATH, spi:PATH@HZ or tcp:ADDRESS:PORT";
/// Returns nullopt if the text is none of kLinkNames.
std::optional<LinkName> read_link_name(std::string_view text);

}  // namespace lockstep
