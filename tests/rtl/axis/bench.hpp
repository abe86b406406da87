// The device in Verilog and the simulated device, with one host: each word that it writes goes to both. After each tick
// both must show the same.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "Vaxis_device.h"
#include "core/hardware/device_abilities.hpp"
#include "sim_fpga/device.hpp"
#include "tests/rtl/axis/compared.hpp"
#include "tests/rtl/axis/verilog_device.hpp"

namespace lockstep::rtl {

/// The same in tests/rtl/axis/CMakeLists.txt.
inline constexpr DeviceAbilities kAbilities{.segment_entries = 64,
                                            .capture_entries = 256,
                                            .longest_piece = Ticks{0xFFFF'FFFF},
                                            .time_unit_ps = 1000,
                                            .longest_time = 65'535,
                                            .longest_pwm_period = 65'535,
                                            .inputs = 8,
                                            .digital_outputs = 8,
                                            .analog_outputs = 2,
                                            .output_entries = 32,
                                            .event_entries = 32,
                                            .has_encoder = false,
                                            .can_compare = false,
                                            .frames_stay = true};
/// Both devices.
class Bench {
public:
    static constexpr const DeviceAbilities& kAbilities = rtl::kAbilities;

    explicit Bench(Tick now)
        : window_(RegisterWindow::in_process()),
          simulated_(window_, far_plant(), 1000, now, 0, kAbilities),
          verilog_(now) {}

    void store(std::size_t offset, std::uint64_t value) {
        window_.store(offset, value);
        verilog_.write(offset, value);
    }
    /// What the simulated device shows, and so both.
    std::uint64_t load(std::size_t offset) const { return window_.load(offset); }
    Plant& plant_of_device() { return simulated_.plant(); }
    Tick now() const { return simulated_.now(); }
    VerilogDevice<Vaxis_device>& verilog() { return verilog_; }

    /// Executes a tick in both, and compares them.
    void tick() {
        const std::uint32_t before = simulated_.plant().pins();
        const auto count = static_cast<std::int64_t>(load(registers::kCount));
        simulated_.advance(now() + Ticks{1});
        const int step = verilog_.tick(before, [this](int) { return simulated_.plant().pins(); });
        EXPECT_EQ(step, static_cast<std::int64_t>(load(registers::kCount)) - count) << where();
        for (const auto& [name, offset] : kWordsOfEachTick) { compare(name, offset, load(offset)); }
        if (now().value % 8 == 0) { compare_rest(); }
    }
    /// Compares the words that no tick changes without changing one of the others.
    void compare_rest() {
        for (const auto& [name, offset] : kOtherWords) { compare(name, offset, load(offset)); }
    }

private:
    std::string where() const { return "at tick " + std::to_string(now().value); }
    void compare(const char* name, std::size_t offset, std::uint64_t expected) {
        ASSERT_EQ(verilog_.read(offset), expected) << name << ' ' << where();
    }

    RegisterWindow window_;
    SimulatedDevice simulated_;
    VerilogDevice<Vaxis_device> verilog_;
};

}  // namespace lockstep::rtl
