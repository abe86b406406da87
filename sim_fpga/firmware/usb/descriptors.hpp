// What the board says of itself as a USB device: a serial line by the class CDC ACM, for which each operating system
// has a driver (Universal Serial Bus Specification 2.0, chapter 9; CDC 1.2 and PSTN 1.2).
#pragma once

#include <cstddef>
#include <cstdint>

namespace lockstep::firmware::usb {

/// The pair that Raspberry Pi keeps for serial lines of an RP2040. Its list of product numbers (raspberrypi/usb-pid)
/// asks devices with a standard driver to use a standard pair, and to tell themselves apart by their texts.
inline constexpr std::uint16_t kVendor = 0x2E8A, kProduct = 0x000A;

inline constexpr std::size_t kPacketBytes = 64;  // of the control endpoint and the line's
inline constexpr unsigned kNoticeEndpoint = 1;   // to the host; it is never used
inline constexpr unsigned kLineEndpoint = 2;     // both ways

enum class DescriptorKind : std::uint8_t { Device = 1, Configuration = 2, Text = 3 };

struct Bytes {
    const std::uint8_t* at = nullptr;
    std::size_t size = 0;
};

/// The texts, with the board's own serial number.
class Descriptors {
public:
    explicit Descriptors(std::uint64_t serial);

    /// Nothing if there is no such descriptor.
    Bytes find(DescriptorKind kind, unsigned number) const;

private:
    static constexpr std::size_t kDigits = 16;
    std::uint8_t serial_[2 + 2 * kDigits];
};

}  // namespace lockstep::firmware::usb
