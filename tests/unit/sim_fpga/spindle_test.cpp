// A simulated spindle: when it has its speed, and how the device's input shows it.
#include <gtest/gtest.h>

#include "sim_fpga/wiring/spindle.hpp"
#include "tests/unit/sim_fpga/device_bench.hpp"

namespace lockstep {
namespace {

constexpr Ticks kSpinUp{100'000};

TEST(Spindle, ComesToItsSpeedWithAConstantAcceleration) {
    Spindle spindle({.spin_up = kSpinUp});
    EXPECT_FALSE(spindle.has_speed(Tick{5}));
    spindle.drive(0.5, Tick{1000});
    EXPECT_DOUBLE_EQ(spindle.speed_at(Tick{11'000}), 0.1);
    const Tick has_it = spindle.next(Tick{1000}).value();
    EXPECT_EQ(has_it, Tick{49'000}) << "within 2 % of full speed";
    EXPECT_FALSE(spindle.has_speed(has_it - Ticks{1}));
    EXPECT_TRUE(spindle.has_speed(has_it));
    EXPECT_DOUBLE_EQ(spindle.speed_at(Tick{1'000'000}), 0.5);
}

TEST(Spindle, LosesItsSpeedAtAnotherOneAndOff) {
    Spindle spindle({.spin_up = kSpinUp});
    spindle.drive(1, Tick{0});
    spindle.drive(0.3, Tick{200'000});
    EXPECT_FALSE(spindle.has_speed(Tick{200'000}));
    EXPECT_TRUE(spindle.has_speed(Tick{270'000}));
    spindle.drive(0, Tick{300'000});
    EXPECT_FALSE(spindle.has_speed(Tick{300'000}));
    EXPECT_EQ(spindle.next(Tick{300'000}), std::nullopt);
    EXPECT_FALSE(spindle.has_speed(Tick{900'000})) << "a spindle that stands has no speed";
}

TEST(Spindle, ClosesTheInputOfItsDeviceWhileItHasItsSpeed) {
    DeviceBench bench(endless_axis());
    bench.device.plant().wiring().connect({.output = 2, .spin_up = kSpinUp, .input = 5});
    (void)bench.at(Tick{1000});
    bench.order(device::ChangeOutputs{.digital = {.levels = 4, .mask = 4}});
    EXPECT_EQ(bench.at(Tick{50'000}).inputs, 0U);
    EXPECT_EQ(bench.at(Tick{120'000}).inputs, 1U << 5);
    bench.order(device::ChangeOutputs{.digital = {.levels = 0, .mask = 4}});
    EXPECT_EQ(bench.at(Tick{121'000}).inputs, 0U);
}

}  // namespace
}  // namespace lockstep
