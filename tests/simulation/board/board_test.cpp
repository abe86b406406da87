// The firmware in an emulator of the RP2040: one board, three motors, each edge of a pin where core/step puts it.
#include <gtest/gtest.h>

#include <array>

#include "tests/simulation/board/board_fixture.hpp"

namespace lockstep::testing {
namespace {

TEST_F(Board, MakesEachPinEdgeOfItsFrames) {
    const Tick start = soon();
    const std::array courses{course(1, start, kFrames), course(2, start, kFrames), course(3, start, kFrames)};
    for (std::size_t motor = 0; motor < kMotors; ++motor) { order(motor, courses[motor]); }
    for (std::size_t motor = 0; motor < kMotors; ++motor) { run_to_end(motor); }
    run(bench.now_us() + 1000);
    for (std::size_t motor = 0; motor < kMotors; ++motor) { expect_steps(courses[motor], motor); }
    EXPECT_LE(bench.busiest(), 0.88) << "sim_fpga/firmware/README.md states it";
}

/// Each motor has a driver of its own kind. The times are the longest, some in between, and some below a tick.
TEST_F(Board, KeepsThePulseTimesOfEachDriver) {
    const Tick start = soon();
    const std::array courses{course(6, start, kFrames), course(7, start, kFrames), course(8, start, kFrames)};
    const std::array<DeviceSetup, kMotors> setups{
        {{.step_width_ns = 7000, .direction_setup_ns = 7000, .direction_hold_ns = 7000},
         {.step_width_ns = 2500, .direction_setup_ns = 5000, .direction_hold_ns = 5000},
         {.step_width_ns = 500, .direction_setup_ns = 600}}};
    constexpr std::array<PinTimes, kMotors> kTimes{
        {{.pulse = 7, .delay = 23, .setup = 7}, {.pulse = 3, .delay = 21, .setup = 5}, {}}};
    for (std::size_t motor = 0; motor < kMotors; ++motor) {
        bench.expect(motor, kTimes[motor]);
        order(motor, courses[motor], setups[motor]);
    }
    for (std::size_t motor = 0; motor < kMotors; ++motor) { run_to_end(motor); }
    run(bench.now_us() + 1000);
    for (std::size_t motor = 0; motor < kMotors; ++motor) { expect_steps(courses[motor], motor); }
}

TEST_F(Board, LeavesOutAStepAndItsOppositeThatPinsCannotFollow) {
    const Tick start = soon();
    const std::array courses{turns(1, start), turns(2, start), turns(3, start)};
    for (std::size_t motor = 0; motor < kMotors; ++motor) {
        bench.expect(motor, {.pulse = 7, .delay = 23, .setup = 7});
        order(motor, courses[motor], {.step_width_ns = 7000, .direction_setup_ns = 7000, .direction_hold_ns = 7000});
        EXPECT_GT(courses[motor].steps.size() - without_short_turns(courses[motor].steps).size(), 40U);
    }
    for (std::size_t motor = 0; motor < kMotors; ++motor) { run_to_end(motor); }
    run(bench.now_us() + 1000);
    for (std::size_t motor = 0; motor < kMotors; ++motor) { expect_steps(courses[motor], motor); }
}

TEST_F(Board, RefusesPulseTimesThatItCannotKeep) {
    EXPECT_FALSE(drivers[0].set_up({.step_width_ns = 7001}));
    EXPECT_FALSE(drivers[0].set_up({.direction_hold_ns = 8000}));
    EXPECT_TRUE(drivers[0].set_up({.direction_setup_ns = 7000}));
}

TEST_F(Board, FlashesItsLightWhenItsHostAsksForIt) {
    constexpr std::uint32_t kPattern_us = 1 << 20;
    bench.host(HostLine::Uart).identify();
    bench.run(bench.now_us() + kPattern_us / 16);
    const int asked = bench.flashes();
    bench.run(bench.now_us() + kPattern_us);
    EXPECT_EQ(bench.flashes(), asked + 4);
}

/// Motor 0 may run two frames. The switch of motor 1 closes on its way. Motor 2 is not concerned, and a byte of a
/// thousand is damaged.
TEST_F(Board, EndsInATailOrAtASwitchAndCountsWhatItMade) {
    constexpr Ticks kWay{60'000};
    constexpr std::int64_t kDelay = 1168;  // from a switch to the pins
    bench.damage();
    const Tick start = soon() + Ticks{200'000};
    const std::array courses{course(4, start, 2), long_way(start, kWay), course(5, start, kFrames)};
    for (std::size_t motor = 0; motor < kMotors; ++motor) { order(motor, courses[motor]); }
    const Tick closed = start + Ticks{20'000};
    run(closed.value);
    bench.close_switch(1);
    for (std::size_t motor = 0; motor < kMotors; ++motor) { run_to_end(motor); }
    run(bench.now_us() + 1000);
    expect_steps(courses[0], 0);
    expect_steps(courses[2], 2);
    const auto status = drivers[1].read();
    ASSERT_TRUE(status);
    EXPECT_TRUE(status->stopped_by_limit);
    ASSERT_FALSE(bench.steps(1).empty());
    EXPECT_EQ(status->position.count(), static_cast<std::int64_t>(bench.steps(1).size()));
    EXPECT_LE(bench.steps(1).back().tick, closed + Ticks{kDelay + 5000})
        << "the board's first tick is 5 ms behind power-up";
    EXPECT_GE(bench.steps(1).back().tick, closed - Ticks{5000});
}

}  // namespace
}  // namespace lockstep::testing
