// sim_fpga/rtl/axis/axis_device.v as a device with a register map: a host reads and writes words between its ticks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "core/units.hpp"
#include "tests/rtl/clocked.hpp"

namespace lockstep::rtl {

/// Module: as Verilator translates it, with any parameters.
template <typename Module>
class VerilogDevice {
public:
    /// Powers up at rest after tick `now`. power_up: for POWER_UP.
    explicit VerilogDevice(Tick now, std::uint64_t power_up = 0) {
        auto& pins = hardware_.pins;
        pins.first_tick = static_cast<std::uint64_t>(now.value);
        pins.power_up = power_up;
        pins.write = pins.hold = pins.tick = pins.pins = 0;
        settle([](int) { return 0U; });
    }

    /// offset: as in a RegisterWindow.
    void write(std::size_t offset, std::uint64_t value) {
        auto& pins = hardware_.pins;
        pins.write = 1;
        pins.write_address = static_cast<std::uint32_t>(offset / sizeof value);
        pins.write_data = value;
        hardware_.clock();
        pins.write = 0;
    }
    std::uint64_t read(std::size_t offset) {
        hardware_.pins.read_address = static_cast<std::uint32_t>(offset / sizeof(std::uint64_t));
        hardware_.clock();
        hardware_.clock();
        return hardware_.pins.read_data;
    }

    /// While they are held, the device's words stay as they are, and ticks take fewer clocks.
    void hold_words(bool held) { hardware_.pins.hold = held; }

    /// A tick is being executed.
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

    /// Executes a tick with these levels of the input pins. If it makes a step, calls on_step(direction), which returns
    /// the levels after the step. Returns the step.
    template <typename OnStep>
    int tick(std::uint32_t levels, OnStep&& on_step) {
        auto& pins = hardware_.pins;
        pins.pins = static_cast<std::uint8_t>(levels);
        pins.tick = 1;
        hardware_.clock();
        pins.tick = 0;
        return settle(on_step);
    }

private:
    static constexpr int kMostClocks = 2'000;

    template <typename OnStep>
    int settle(OnStep&& on_step) {
        auto& pins = hardware_.pins;
        int made = 0;
        int clocks = 0;
        for (pins.eval(); pins.busy != 0 && clocks < kMostClocks; ++clocks) {
            const int step = pins.step == 0 ? 0 : pins.forward != 0 ? 1 : -1;
            hardware_.clock();
            if (step == 0) { continue; }
            made += step;
            pins.pins = static_cast<std::uint8_t>(on_step(step));
            pins.eval();
        }
        if (clocks == kMostClocks) { throw std::runtime_error("a tick does not end"); }
        return made;
    }

    Clocked<Module> hardware_;
};

}  // namespace lockstep::rtl
