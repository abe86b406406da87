// A board whose motors have drivers, for tests.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "tests/simulation/board/board_bench.hpp"
#include "tests/simulation/board/courses.hpp"

namespace lockstep::testing {

class Board : public ::testing::Test {
protected:
    void SetUp() override { connect(HostLine::Uart); }
    void connect(HostLine line) {
        await_answer(line);
        for (std::size_t motor = 0; motor < kMotors; ++motor) { drivers.push_back(bench.host(line).driver(motor)); }
    }
    void await_answer(HostLine line) {
        const std::uint32_t end = bench.now_us() + 400'000;
        while (!bench.host(line).is_connected()) {
            ASSERT_LT(bench.now_us(), end) << "the board does not answer";
            bench.run(bench.now_us() + 1000);
        }
    }
    /// For the line to bring all frames to the board.
    Tick soon() const { return Tick{static_cast<std::int64_t>(bench.now_us()) + 120'000}; }

    void order(std::size_t motor, const Course& course, const DeviceSetup& setup = {}) {
        ASSERT_TRUE(drivers[motor].set_up(setup));
        ASSERT_TRUE(drivers[motor].apply(device::BeginRun{1}));
        for (const auto& frame : course.frames) { ASSERT_TRUE(drivers[motor].apply(frame)); }
        ASSERT_TRUE(drivers[motor].apply(device::Arm{course.armed}));
    }
    void run(std::int64_t until_us) {
        while (bench.now_us() < until_us) {
            bench.run(bench.now_us() + 1000);
            for (std::size_t motor = 0; motor < kMotors; ++motor) {
                ASSERT_TRUE(drivers[motor].drain_capture([&](StepEdge step) { recorded[motor].push_back(step); }));
            }
        }
    }
    /// Until the line has brought the news that the motor's run has ended, which come behind the ticks of all steps.
    void run_to_end(std::size_t motor) {
        for (int left = 200; left > 0; --left) {
            const auto status = drivers[motor].read();
            if (status && status->run == 1 && status->finished) { return; }
            run(bench.now_us() + 10'000);
        }
        ADD_FAILURE() << "motor " << motor << " does not end its run";
    }
    void expect_steps(const Course& course, std::size_t motor) {
        const std::vector<StepEdge> edges = without_short_turns(course.steps);
        EXPECT_TRUE(bench.steps(motor) == edges)
            << "motor " << motor << ": " << bench.steps(motor).size() << " edges, not " << edges.size();
        EXPECT_TRUE(recorded[motor] == course.steps) << recorded[motor].size() << " recorded";
        const auto status = drivers[motor].read();
        ASSERT_TRUE(status);
        EXPECT_TRUE(status->finished && !status->bad_segment && !status->capture_overflow);
        EXPECT_EQ(status->in_tail, course.armed < course.frames.size());
    }

    BoardBench bench;
    std::vector<DeviceDriver> drivers;
    std::array<std::vector<StepEdge>, kMotors> recorded;
};

}  // namespace lockstep::testing
