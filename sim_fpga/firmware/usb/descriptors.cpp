#include "sim_fpga/firmware/usb/descriptors.hpp"

namespace lockstep::firmware::usb {
namespace {

constexpr std::uint8_t low(std::size_t value) { return static_cast<std::uint8_t>(value & 0xFF); }
constexpr std::uint8_t high(std::size_t value) { return static_cast<std::uint8_t>(value >> 8); }
constexpr std::uint8_t kind(DescriptorKind one) { return static_cast<std::uint8_t>(one); }

constexpr std::uint8_t kToHost = 0x80;
constexpr std::uint8_t kInterface = 4, kEndpoint = 5, kClassPart = 0x24;
constexpr std::uint8_t kCommunication = 2, kData = 10;  // classes
constexpr std::uint8_t kBulk = 2, kInterrupt = 3;
enum Text : std::uint8_t { kLanguages, kMaker, kName, kSerial };

constexpr std::uint8_t kDevice[] = {
    // USB 2.0, the class of all its interfaces, the control endpoint's packets
    18, kind(DescriptorKind::Device), 0x00, 0x02, kCommunication, 0, 0, low(kPacketBytes),
    // who made it, which release, its texts, one configuration
    low(kVendor), high(kVendor), low(kProduct), high(kProduct), 0x00, 0x01, kMaker, kName, kSerial, 1};

constexpr std::uint8_t kConfiguration[] = {
    // 67 bytes, two interfaces, number 1 without a text, powered by the bus, up to 100 mA
    9, kind(DescriptorKind::Configuration), 67, 0, 2, 1, 0, 0x80, 50,
    // The first interface controls the line: one endpoint, abstract control model, no protocol.
    9, kInterface, 0, 0, 1, kCommunication, 2, 0, 0,
    // CDC 1.1
    5, kClassPart, 0, 0x10, 0x01,
    // no calls
    5, kClassPart, 1, 0, 1,
    // It has a line coding and a control line state.
    4, kClassPart, 2, 2,
    // Both interfaces belong together.
    5, kClassPart, 6, 0, 1,
    // 8 bytes every 16 ms
    7, kEndpoint, kToHost | kNoticeEndpoint, kInterrupt, 8, 0, 16,
    // The second interface carries the bytes: two endpoints.
    9, kInterface, 1, 0, 2, kData, 0, 0, 0,
    // from the host
    7, kEndpoint, kLineEndpoint, kBulk, low(kPacketBytes), 0, 0,
    // to the host
    7, kEndpoint, kToHost | kLineEndpoint, kBulk, low(kPacketBytes), 0, 0};
static_assert(sizeof kConfiguration == 67, "its length is in it");

constexpr std::uint8_t kTextOfLanguages[] = {4, kind(DescriptorKind::Text), 0x09, 0x04};  // English

/// A text as a descriptor: two bytes a character.
template <std::size_t Size>
struct TextDescriptor {
    std::uint8_t bytes[2 * Size]{};
    constexpr explicit TextDescriptor(const char (&text)[Size]) {
        bytes[0] = 2 * Size;
        bytes[1] = kind(DescriptorKind::Text);
        for (std::size_t n = 0; n + 1 < Size; ++n) { bytes[2 + 2 * n] = static_cast<std::uint8_t>(text[n]); }
    }
};
constexpr TextDescriptor kTextOfMaker("Lockstep");
constexpr TextDescriptor kTextOfName("Motor board");

template <std::size_t Size>
Bytes all_of(const std::uint8_t (&bytes)[Size]) {
    return {bytes, Size};
}

}  // namespace

Descriptors::Descriptors(std::uint64_t serial) : serial_{sizeof serial_, kind(DescriptorKind::Text)} {
    for (std::size_t n = 0; n < kDigits; ++n) {
        const auto digit = static_cast<std::uint8_t>(serial >> 4 * (kDigits - 1 - n) & 0xF);
        serial_[2 + 2 * n] = static_cast<std::uint8_t>(digit < 10 ? '0' + digit : 'A' + digit - 10);
    }
}

Bytes Descriptors::find(DescriptorKind kind, unsigned number) const {
    if (kind == DescriptorKind::Device && number == 0) { return all_of(kDevice); }
    if (kind == DescriptorKind::Configuration && number == 0) { return all_of(kConfiguration); }
    if (kind != DescriptorKind::Text) { return {}; }
    switch (number) {
        case kLanguages: return all_of(kTextOfLanguages);
        case kMaker: return all_of(kTextOfMaker.bytes);
        case kName: return all_of(kTextOfName.bytes);
        case kSerial: return all_of(serial_);
        default: return {};
    }
}

}  // namespace lockstep::firmware::usb
