// sim_fpga/rtl/axis/axis_device.v beside sim_fpga/device.hpp: both get the same words from a host that draws them, and
// must show the same words after every tick.
#include <gtest/gtest.h>

#include <cstdint>

#include "tests/rtl/axis/bench.hpp"
#include "tests/rtl/axis/coverage.hpp"
#include "tests/rtl/axis/drawn_host.hpp"
#include "tests/rtl/axis/one_frame.hpp"

namespace lockstep::rtl {
namespace {

TEST(AxisHardware, ShowsTheWordsOfTheSimulatedDeviceAfterEveryTickForAnyHost) {
    Bench bench(Tick{1'000'000});
    DrawnHost<Bench> host(bench, 4);
    Coverage covered;
    while (host.pieces() < wanted_pieces() && !HasFailure()) {
        host.act();
        bench.tick();
        covered.note(bench);
    }
    covered.expect_all();
}

/// The simulated device refuses such a frame when it should begin.
TEST(AxisHardware, EndsTheRunInTheTickInWhichTheVelocityLeaves64Bits) {
    using namespace registers;
    VerilogDevice<Vaxis_device> device(Tick{0});
    const auto write = [&](std::size_t offset, std::uint64_t value) { device.write(offset, value); };
    run_one_frame(write, 2, 100, 0, std::uint64_t{1} << 61);
    int steps = 0;
    for (int tick = 0; tick < 20; ++tick) {
        steps += device.tick(0, [](int) { return 0U; });
    }
    EXPECT_EQ(steps, 1);  // 1/8 + 2/8 + 3/8 of a step, and 4/8 would be the next
    EXPECT_EQ(device.read(kStatus), kStatusFinished | kStatusBadSegment | kStatusEnabled);
    EXPECT_EQ(device.read(kVelocity), 0);
}

/// The pins would show its step too late.
TEST(AxisHardware, ATickWhoseStepIsNotMadeBeforeTheNextOneEndsTheRunAndAllFurtherOnes) {
    using namespace registers;
    VerilogDevice<Vaxis_device> device(Tick{0});
    const auto write = [&](std::size_t offset, std::uint64_t value) { device.write(offset, value); };
    const auto run_ticks = [&](int ticks) {
        int steps = 0;
        for (; ticks > 0; --ticks) {
            steps += device.tick(0, [](int) { return 0U; });
        }
        return steps;
    };
    run_one_frame(write, 2, 100, std::uint64_t{1} << 62, 0);
    device.begin_tick();
    EXPECT_EQ(run_ticks(1), 0) << "at rest a tick may wait";
    EXPECT_EQ(device.read(kStatus) & kStatusLostTicks, 0);
    EXPECT_EQ(run_ticks(7), 2);
    device.begin_tick();
    (void)run_ticks(1);
    EXPECT_EQ(device.read(kStatus), kStatusFinished | kStatusLostTicks | kStatusEnabled);
    device.write(kRunRequest, 2);
    EXPECT_EQ(run_ticks(20), 0);
    EXPECT_EQ(device.read(kStatus), kStatusFinished | kStatusLostTicks | kStatusEnabled);
}

TEST(AxisHardware, ATickThatEndsLateAfterItsStepLosesNothing) {
    using namespace registers;
    VerilogDevice<Vaxis_device> device(Tick{0});
    const auto write = [&](std::size_t offset, std::uint64_t value) { device.write(offset, value); };
    run_one_frame(write, 2, 40, std::uint64_t{1} << 62, 0);
    for (int ticks = 0; ticks < 50; ticks += 2) {
        device.begin_tick();
        for (int clocks = 0; clocks < 50; clocks += 2) { (void)device.read(kTick); }  // its step is made in these
        EXPECT_TRUE(device.is_busy());
        (void)device.tick(0, [](int) { return 0U; });
    }
    EXPECT_EQ(device.read(kCount), 10);
    EXPECT_EQ(device.read(kStatus), kStatusFinished | kStatusEnabled);
}

}  // namespace
}  // namespace lockstep::rtl
