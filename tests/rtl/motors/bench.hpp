// The devices of several motors in Verilog, and as many simulated devices, each with one host: each word that a host
// writes goes to both. After each tick both must show the same.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "core/hardware/device_abilities.hpp"
#include "sim_fpga/device.hpp"
#include "tests/rtl/axis/compared.hpp"
#include "tests/rtl/motors/verilog_motors.hpp"

namespace lockstep::rtl {

/// The same in sim_fpga/rtl/motors/program/0_registers.asm.
inline constexpr DeviceAbilities kMotorsAbilities{.segment_entries = 256,
                                                  .capture_entries = 256,
                                                  .longest_piece = Ticks{0xFFFF'FFFF},
                                                  .time_unit_ps = 166'667,
                                                  .longest_time = 94,
                                                  .longest_pwm_period = 0,
                                                  .inputs = 8,
                                                  .digital_outputs = 8,
                                                  .analog_outputs = 2,
                                                  .output_entries = 32,
                                                  .event_entries = 32,
                                                  .has_encoder = false,
                                                  .can_compare = false,
                                                  .frames_stay = true};

/// One of the motors: its simulated device beside the one in Verilog.
template <typename Hardware>
class MotorBench {
public:
    static constexpr const DeviceAbilities& kAbilities = kMotorsAbilities;

    MotorBench(Hardware& hardware, std::size_t motor)
        : hardware_(hardware),
          motor_(motor),
          window_(RegisterWindow::in_process()),
          simulated_(window_, far_plant(), 1000, Tick{0}, 0, kMotorsAbilities) {}

    void store(std::size_t offset, std::uint64_t value) {
        window_.store(offset, value);
        hardware_.write(motor_, offset, value);
    }
    /// What the simulated device shows, and so both.
    std::uint64_t load(std::size_t offset) const { return window_.load(offset); }
    Plant& plant_of_device() { return simulated_.plant(); }
    Tick now() const { return simulated_.now(); }
    /// The device in Verilog.
    class Verilog {
    public:
        Verilog(Hardware& hardware, std::size_t motor) : hardware_(hardware), motor_(motor) {}
        std::uint64_t read(std::size_t offset) { return hardware_.read(motor_, offset); }

    private:
        Hardware& hardware_;
        std::size_t motor_;
    };
    Verilog verilog() { return {hardware_, motor_}; }

    /// Executes a tick in the simulated device.
    void advance() {
        count_ = static_cast<std::int64_t>(load(registers::kCount));
        simulated_.advance(now() + Ticks{1});
    }
    /// Compares what both show, and the steps of the tick.
    void compare(int steps) {
        EXPECT_EQ(steps, static_cast<std::int64_t>(load(registers::kCount)) - count_) << where();
        hardware_.show(motor_);
        for (const auto& [name, offset] : kWordsOfEachTick) { compare(name, offset); }
        if (now().value % 8 == 0) {
            for (const auto& [name, offset] : kOtherWords) { compare(name, offset); }
        }
    }

private:
    std::string where() const { return "motor " + std::to_string(motor_) + " at tick " + std::to_string(now().value); }
    void compare(const char* name, std::size_t offset) {
        ASSERT_EQ(hardware_.read(motor_, offset), load(offset)) << name << ' ' << where();
    }

    Hardware& hardware_;
    std::size_t motor_;
    RegisterWindow window_;
    SimulatedDevice simulated_;
    std::int64_t count_ = 0;
};

/// All motors.
template <typename Module, std::size_t kMotors>
class MotorsBench {
public:
    using Hardware = VerilogMotors<Module, kMotors>;
    using Motor = MotorBench<Hardware>;

    MotorsBench() {
        for (std::size_t n = 0; n < kMotors; ++n) { motors_[n] = std::make_unique<Motor>(hardware_, n); }
    }
    Motor& motor(std::size_t n) { return *motors_[n]; }

    /// Executes a tick in all devices, and compares them.
    void tick() {
        typename Hardware::Levels levels{};
        for (std::size_t n = 0; n < kMotors; ++n) {
            levels[n] = motor(n).plant_of_device().pins();
            motor(n).advance();
        }
        std::array<int, kMotors> steps{};
        (void)hardware_.tick(levels, [&](std::size_t n, int direction) {
            steps[n] += direction;
            levels[n] = motor(n).plant_of_device().pins();
            return levels;
        });
        for (std::size_t n = 0; n < kMotors; ++n) { motor(n).compare(steps[n]); }
    }

private:
    Hardware hardware_;
    std::array<std::unique_ptr<Motor>, kMotors> motors_;
};

}  // namespace lockstep::rtl
