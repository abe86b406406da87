// A line to a host: the board's own plug, as a serial line by USB (CDC ACM).
//
// No interrupt is needed: serve() is called by the loop that serves the host, at least every 64 us, and until then the
// controller answers the host by itself that it must wait. So USB never takes time from the execution of ticks.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/link/line.hpp"
#include "sim_fpga/firmware/rp2040/usb_endpoint.hpp"
#include "sim_fpga/firmware/usb/control_requests.hpp"

namespace lockstep::firmware {

class UsbLine final : public Line {
public:
    /// serial: the device's serial number.
    explicit UsbLine(std::uint64_t serial);

    void start();
    /// Does what the host has asked for: resets of the bus, control requests.
    void serve();
    bool receive(std::uint8_t& byte) override;
    /// While no program on the host has the line open, the bytes are lost.
    std::size_t send(const std::uint8_t* bytes, std::size_t size) override;
    bool takes_boot_request() { return requests_.takes_boot_request(); }

private:
    /// What the next packet of the control endpoint ends or goes on with.
    enum class Stage : std::uint8_t { Idle, Sending, Receiving, Ending };

    void reset();
    void take_setup();
    void answer(const usb::Reply& reply);
    void restart(unsigned ends);
    void send_data();
    void end_request();
    void sent_packet();
    void received_packet();

    usb::ControlRequests requests_;
    TwoBuffers in_;
    TwoBuffers out_;
    std::size_t taken_ = 0;  // bytes of the oldest packet that were received
    Stage stage_ = Stage::Idle;
    usb::Bytes left_;         // of the reply in progress
    std::uint32_t kind_ = 0;  // of the control endpoint's next packet
};

}  // namespace lockstep::firmware
