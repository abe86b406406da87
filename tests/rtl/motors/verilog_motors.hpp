// sim_fpga/rtl/motors/motors_device.v as devices with register maps: a host reads and writes words between their ticks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "tests/rtl/clocked.hpp"
#include "tests/rtl/motors/host_port.hpp"

namespace lockstep::rtl {

/// Module: as Verilator translates it, for this number of motors.
template <typename Module, std::size_t kMotors>
class VerilogMotors {
public:
    VerilogMotors(const VerilogMotors&) = delete;
    using Levels = std::array<std::uint32_t, kMotors>;

    /// Powers up at rest after tick 0.
    VerilogMotors() {
        hardware_.pins.tick = 0;
        set_pins({});
        settle([](std::size_t, int) { return Levels{}; });
    }

    void write(std::size_t motor, std::size_t offset, std::uint64_t value) { host_.write(motor, offset, value); }
    std::uint64_t read(std::size_t motor, std::size_t offset) { return host_.read(motor, offset); }
    void show(std::size_t motor) { host_.show(motor); }

    bool is_busy() {
        hardware_.pins.eval();
        return hardware_.pins.busy != 0;
    }
    /// A tick that is not awaited.
    void begin_tick() {
        hardware_.pins.tick = 1;
        hardware_.clock();
        hardware_.pins.tick = 0;
    }

    /// Executes a tick with these levels of the input pins. Calls on_step(motor, direction) for each step; it returns
    /// the levels after the step. Returns the clocks that the tick took.
    template <typename OnStep>
    int tick(const Levels& levels, OnStep&& on_step) {
        set_pins(levels);
        begin_tick();
        return settle(on_step);
    }

private:
    static constexpr unsigned kPinsOfMotor = 15;
    static constexpr int kMostClocks = 200'000;

    void set_pins(const Levels& levels) {
        auto& pins = hardware_.pins;
        for (std::size_t motor = 0; motor < kMotors; ++motor) {
            for (unsigned n = 0; n < kPinsOfMotor; ++n) {
                const std::size_t bit = kPinsOfMotor * motor + n;
                set_bit(pins.pins, bit, (levels[motor] >> n & 1) != 0);
            }
        }
    }
    template <typename Word>
    static void set_bit(Word& word, std::size_t bit, bool set) {
        if constexpr (requires { word[0]; }) {
            set_bit(word[bit / 32], bit % 32, set);
        } else {
            word = static_cast<Word>((word & ~(Word{1} << bit)) | (Word{set} << bit));
        }
    }

    template <typename OnStep>
    int settle(OnStep&& on_step) {
        auto& pins = hardware_.pins;
        int clocks = 0;
        for (pins.eval(); pins.busy != 0; ++clocks) {
            const int step = pins.step_forward != 0 ? 1 : pins.step_backward != 0 ? -1 : 0;
            const std::size_t motor = pins.motor;
            hardware_.clock();
            if (step != 0) { set_pins(on_step(motor, step)); }
            if (clocks == kMostClocks) { throw std::runtime_error("a tick does not end"); }
            pins.eval();
        }
        return clocks;
    }

    Clocked<Module> hardware_;
    HostPort<Module> host_{hardware_.pins, [this] { hardware_.clock(); }};
};

}  // namespace lockstep::rtl
