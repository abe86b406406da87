#include "sim_fpga/firmware/usb/control_requests.hpp"

namespace lockstep::firmware::usb {
namespace {

constexpr unsigned kTypeMask = 0x60, kStandard = 0x00, kOfClass = 0x20;
constexpr std::uint8_t kToEndpoint = 0x02;
constexpr std::uint32_t kBootSpeed = 1200;
constexpr unsigned kLineInterface = 1;

enum Standard : std::uint8_t {
    kGetStatus = 0,
    kClearFeature = 1,
    kSetAddress = 5,
    kGetDescriptor = 6,
    kGetConfiguration = 8,
    kSetConfiguration = 9,
    kGetInterface = 10,
    kSetInterface = 11
};
enum OfClass : std::uint8_t { kSetLineCoding = 0x20, kGetLineCoding = 0x21, kSetControlLineState = 0x22 };

constexpr std::uint8_t kZeros[2] = {};

Reply data(const std::uint8_t* bytes, std::size_t size, const SetupPacket& setup) {
    return {Reply::Kind::Data, {bytes, size < setup.length ? size : setup.length}};
}
Reply done(unsigned restarts = 0) { return {Reply::Kind::Done, {}, restarts}; }

bool reads(const SetupPacket& setup, std::uint8_t request) { return setup.is_to_host() && setup.request == request; }
bool writes(const SetupPacket& setup, std::uint8_t request) { return !setup.is_to_host() && setup.request == request; }

}  // namespace

void ControlRequests::reset() {
    address_ = configuration_ = 0;
    is_open_ = false;
}

Reply ControlRequests::take(const SetupPacket& setup) {
    switch (setup.type & kTypeMask) {
        case kStandard: return take_standard(setup);
        case kOfClass: return take_of_line(setup);
        default: return {};
    }
}

Reply ControlRequests::take_standard(const SetupPacket& setup) {
    if (reads(setup, kGetDescriptor)) { return describe(setup); }
    if (reads(setup, kGetStatus)) { return data(kZeros, 2, setup); }
    if (reads(setup, kGetConfiguration)) { return data(&configuration_, 1, setup); }
    if (reads(setup, kGetInterface)) { return data(kZeros, 1, setup); }
    if (writes(setup, kSetConfiguration)) { return configure(setup); }
    if (writes(setup, kClearFeature)) { return end_halt(setup); }
    if (writes(setup, kSetAddress)) {
        address_ = static_cast<std::uint8_t>(setup.value & 0x7F);
        return done();
    }
    if (writes(setup, kSetInterface) && setup.value == 0) {
        return done(setup.index == kLineInterface ? kRestartsIn | kRestartsOut : 0);
    }
    return {};
}

Reply ControlRequests::describe(const SetupPacket& setup) const {
    const Bytes found = descriptors_.find(static_cast<DescriptorKind>(setup.value >> 8), setup.value & 0xFF);
    return found.size == 0 ? Reply{} : data(found.at, found.size, setup);
}

Reply ControlRequests::configure(const SetupPacket& setup) {
    if (setup.value > 1) { return {}; }
    configuration_ = static_cast<std::uint8_t>(setup.value);
    is_open_ = false;
    return done(kRestartsIn | kRestartsOut);
}

/// An endpoint of this device never halts, but the host begins its count of packets again.
Reply ControlRequests::end_halt(const SetupPacket& setup) const {
    if (setup.type != kToEndpoint || setup.value != 0) { return {}; }
    if (setup.index == kLineEndpoint) { return done(kRestartsOut); }
    return done(setup.index == (0x80 | kLineEndpoint) ? kRestartsIn : 0);
}

Reply ControlRequests::take_of_line(const SetupPacket& setup) {
    if (reads(setup, kGetLineCoding)) { return data(coding_, kCodingBytes, setup); }
    if (writes(setup, kSetControlLineState)) { return show_state(setup.value); }
    const bool is_coding = writes(setup, kSetLineCoding) && setup.length == kCodingBytes;
    return is_coding ? Reply{Reply::Kind::AwaitsData} : Reply{};
}

/// Bit 0 (DTR) is set while a program has the line open.
Reply ControlRequests::show_state(std::uint16_t state) {
    const bool was_open = is_open_;
    is_open_ = (state & 1) != 0;
    if (was_open && !is_open_ && speed() == kBootSpeed) { asks_for_boot_ = true; }
    return done();
}

Reply ControlRequests::take_data(const std::uint8_t* bytes, std::size_t size) {
    if (size != kCodingBytes) { return {}; }
    for (std::size_t n = 0; n < kCodingBytes; ++n) { coding_[n] = bytes[n]; }
    return done();
}

std::uint32_t ControlRequests::speed() const {
    std::uint32_t speed = 0;
    for (unsigned n = 0; n < 4; ++n) { speed |= std::uint32_t{coding_[n]} << 8 * n; }
    return speed;
}

bool ControlRequests::takes_boot_request() {
    const bool asks = asks_for_boot_;
    asks_for_boot_ = false;
    return asks;
}

}  // namespace lockstep::firmware::usb
