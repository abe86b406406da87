// A simulated device on the bench with a driver to it, and frames that are easy to compute: a body is 10 steps in
// 1280 ticks, a tail one more step in 128, all at one step per 128 ticks, the first step 64 ticks after the start.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "core/kinematics/motors.hpp"
#include "services/axis/device_driver.hpp"
#include "sim_fpga/device.hpp"

namespace lockstep {

inline constexpr std::int64_t kTick_ns = 1000;
inline constexpr Velocity kBenchSpeed{std::int64_t{1} << 57};
inline constexpr Ticks kBody{1280};
inline constexpr Ticks kTail{128};
inline constexpr Tick kStart{1000};
inline constexpr Tick kMuchLater{100'000};

/// In the middle of 100 mm, 80 steps a mm, with a motor stronger than any motion requires.
inline MotorConfig bench_axis() {
    MotorConfig axis;
    axis.name = "X";
    axis.axis = AxisIndex{0};
    axis.steps_per_mm = 80;
    axis.position_min_mm = 0;
    axis.position_max_mm = 100;
    axis.homing.switch_position_mm = 1;
    axis.plant = {.start_position_mm = 50, .travel_margin_mm = 2, .max_torque_accel_mm_s2 = 1e6, .max_jump_mm_s = 1e4};
    return axis;
}

/// No switch within reach: only the steps matter.
inline MotorConfig endless_axis() {
    MotorConfig axis = bench_axis();
    axis.position_min_mm = -1e6;
    axis.position_max_mm = 1e6;
    axis.homing.switch_position_mm = -1e6;
    return axis;
}

inline device::LoadFrame frame(FrameNumber number, int direction = 1) {
    const auto before = static_cast<std::int64_t>(number - 1);
    const Velocity speed{direction * kBenchSpeed.raw};
    const Position from = rest_position(0, direction < 0) + Piece{kBody * before, speed, {}}.covered();
    return {number, kStart + kBody * before, false, {from, {{kBody, speed, {}}}, {{kTail, speed, {}}}}};
}

inline device::LoadFrame last_frame(FrameNumber number) {
    device::LoadFrame result = frame(number);
    result.last = true;
    result.track.tail.clear();
    return result;
}

struct DeviceBench {
    explicit DeviceBench(const MotorConfig& axis = bench_axis(), const DeviceAbilities& abilities = {},
                         RegisterWindow registers = RegisterWindow::in_process(), const DeviceSetup& setup = {})
        : window(std::move(registers)),
          device(window, Plant(axis, kTick_ns), kTick_ns, Tick{0}, 0, abilities),
          driver(DeviceDriver::attach(window, kTick_ns).value()) {
        EXPECT_TRUE(driver.set_up(setup));
    }

    void order(const DeviceOrder& order) {
        const auto result = driver.apply(order);
        EXPECT_TRUE(result) << result.error();
    }
    DeviceStatus at(Tick tick) {
        device.advance(tick);
        return driver.read().value();
    }
    std::vector<StepEdge> steps() {
        std::vector<StepEdge> made;
        const auto result = driver.drain_capture([&](StepEdge step) { made.push_back(step); });
        EXPECT_TRUE(result) << result.error();
        return made;
    }

    RegisterWindow window;
    SimulatedDevice device;
    DeviceDriver driver;
};

}  // namespace lockstep
