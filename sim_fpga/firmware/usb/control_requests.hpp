// What the host asks of the device by control requests: its descriptors, its address, the state of the line.
//
// It decides; the board's part (rp2040/usb_line.hpp) moves the packets.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/usb/descriptors.hpp"

namespace lockstep::firmware::usb {

struct SetupPacket {
    std::uint8_t type = 0;  // with the direction and the recipient
    std::uint8_t request = 0;
    std::uint16_t value = 0;
    std::uint16_t index = 0;
    std::uint16_t length = 0;

    bool is_to_host() const { return (type & 0x80) != 0; }
};

inline constexpr unsigned kRestartsIn = 1, kRestartsOut = 2;

struct Reply {
    enum class Kind : std::uint8_t { Refused, Done, Data, AwaitsData };
    Kind kind = Kind::Refused;
    Bytes data{};           // to the host, not more than it asked for
    unsigned restarts = 0;  // the ends of the line's endpoint that begin again
};

class ControlRequests {
public:
    explicit ControlRequests(std::uint64_t serial) : descriptors_(serial) {}

    /// The host resets the bus.
    void reset();
    Reply take(const SetupPacket& setup);
    /// The data that a reply awaits.
    Reply take_data(const std::uint8_t* bytes, std::size_t size);

    /// Valid for the device when the request that gave it is done.
    std::uint8_t address() const { return address_; }
    bool is_configured() const { return configuration_ != 0; }
    /// A program on the host has the line open.
    bool is_open() const { return is_configured() && is_open_; }
    /// In bits a second. It has no effect on USB.
    std::uint32_t speed() const;
    /// The line was closed at 1200 bits a second: the usual way to ask a board for its boot mode. It asks once.
    bool takes_boot_request();

private:
    Reply take_standard(const SetupPacket& setup);
    Reply take_of_line(const SetupPacket& setup);
    Reply describe(const SetupPacket& setup) const;
    Reply configure(const SetupPacket& setup);
    Reply end_halt(const SetupPacket& setup) const;
    Reply show_state(std::uint16_t state);

    static constexpr std::size_t kCodingBytes = 7;

    Descriptors descriptors_;
    std::uint8_t address_ = 0;
    std::uint8_t configuration_ = 0;
    std::uint8_t coding_[kCodingBytes] = {0x40, 0x42, 0x0F, 0, 0, 0, 8};  // 1 MBd, 8 bits, no parity
    bool is_open_ = false;
    bool asks_for_boot_ = false;
};

}  // namespace lockstep::firmware::usb
