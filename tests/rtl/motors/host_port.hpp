// How a host reads and writes words of the devices of sim_fpga/rtl/motors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <utility>

namespace lockstep::rtl {

/// Module: with the host's ports of motors_device.v.
template <typename Module>
class HostPort {
public:
    /// clock: makes a period of the clock.
    HostPort(Module& pins, std::function<void()> clock) : pins_(pins), clock_(std::move(clock)) {
        pins_.write = pins_.read = pins_.show = 0;
    }

    /// offset: as in a RegisterWindow of the motor.
    void write(std::size_t motor, std::size_t offset, std::uint64_t value) {
        pins_.host_motor = static_cast<std::uint8_t>(motor);
        pins_.host_address = static_cast<std::uint32_t>(offset / kLimbBytes);
        pins_.write_data = value;
        pins_.write = 1;
        wait_for([&] { return pins_.written != 0; });
        pins_.write = 0;
        clock_();
    }
    /// The device's words are those that were shown last.
    std::uint64_t read(std::size_t motor, std::size_t offset) {
        std::uint64_t word = 0;
        for (unsigned limb = 0; limb < kLimbs; ++limb) {
            word |= std::uint64_t{read_limb(motor, offset / kLimbBytes + limb)} << (16 * limb);
        }
        return word;
    }
    /// Shows the words of a motor.
    void show(std::size_t motor) {
        pins_.host_motor = static_cast<std::uint8_t>(motor);
        pins_.show = 1;
        clock_();
        pins_.show = 0;
        wait_for([&] { return pins_.shows == 0; });
    }

private:
    static constexpr std::size_t kLimbBytes = 2;
    static constexpr unsigned kLimbs = 4;
    static constexpr int kMostClocks = 200'000;

    std::uint16_t read_limb(std::size_t motor, std::size_t limb) {
        pins_.host_motor = static_cast<std::uint8_t>(motor);
        pins_.host_address = static_cast<std::uint32_t>(limb);
        pins_.read = 1;
        wait_for([&] { return pins_.was_read != 0; });
        pins_.read = 0;
        const auto word = static_cast<std::uint16_t>(pins_.read_data);
        clock_();
        return word;
    }
    template <typename Condition>
    void wait_for(Condition&& holds) {
        int clocks = 0;
        do {
            clock_();
            if (++clocks == kMostClocks) { throw std::runtime_error("the device does not answer"); }
        } while (!holds());
    }

    Module& pins_;
    std::function<void()> clock_;
};

}  // namespace lockstep::rtl
