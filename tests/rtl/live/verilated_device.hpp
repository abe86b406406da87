// The device in Verilog behind a register window: words that the host writes there go to the device, and what the
// device shows goes there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "Vaxis_of_machine.h"
#include "services/fpga/served_device.hpp"
#include "sim_fpga/register_ring.hpp"
#include "tests/rtl/axis/verilog_device.hpp"

namespace lockstep::rtl {

class VerilatedDevice final : public ServedDevice {
public:
    explicit VerilatedDevice(const PowerUp& up);

    void advance(Tick until) override;
    bool is_intact() const override;
    Plant& plant() override { return plant_; }

private:
    void take_orders();
    void take_setup();
    void take_direct();
    void take_frames();
    void take_ring(const RegisterRing& ring, std::size_t entry_bytes, std::uint64_t head, std::uint64_t& taken);
    void take(std::size_t offset, std::uint64_t word);
    void take(std::size_t offset) { take(offset, window_.load(offset)); }
    void execute(Tick until);
    void tick();
    void publish();
    void pass(const RegisterRing& ring, std::size_t words, std::size_t head, std::uint64_t& passed);

    RegisterWindow window_;
    Plant plant_;
    std::uint64_t tick_ns_;
    Tick now_;
    VerilogDevice<Vaxis_of_machine> device_;
    RegisterRing segments_;
    RegisterRing changes_;
    RegisterRing captures_;
    RegisterRing events_;
    std::vector<std::uint64_t> taken_;  // the host's registers, as the device has them
    std::uint64_t loaded_ = 0;          // entries of the segment ring that the device has
    std::uint64_t changed_ = 0;         // entries of the output ring that the device has
    std::uint64_t captured_ = 0;        // entries of the capture ring that the window has
    std::uint64_t noted_ = 0;           // entries of the event ring that the window has
    std::uint64_t sequence_ = 0;
};

}  // namespace lockstep::rtl
