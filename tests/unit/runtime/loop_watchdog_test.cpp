// The watchdog detects a loop that stands still. It does not report a loop that runs slowly.
#include "services/runtime/loop_watchdog.hpp"

#include <gtest/gtest.h>

#include <future>

namespace lockstep {
namespace {

using namespace std::chrono_literals;

TEST(LoopWatchdog, ReportsALoopThatStandsStill) {
    std::promise<void> stuck;
    LoopWatchdog watchdog([&] { stuck.set_value(); }, 100ms);
    for (int i = 0; i < 3; ++i) { watchdog.note_loop(); }
    EXPECT_EQ(stuck.get_future().wait_for(20s), std::future_status::ready);
}

TEST(LoopWatchdog, EndsWithItsProcessWithoutReport) {
    std::atomic<bool> is_stuck = false;
    {
        LoopWatchdog watchdog([&] { is_stuck = true; }, 1h);
    }
    EXPECT_FALSE(is_stuck);
}

TEST(LoopWatchdog, ReportsNoLoopThatRuns) {
    std::atomic<bool> is_stuck = false;
    {
        LoopWatchdog watchdog([&] { is_stuck = true; }, 10s);
        for (int i = 0; i < 50; ++i) {
            watchdog.note_loop();
            std::this_thread::sleep_for(10ms);
        }
    }
    EXPECT_FALSE(is_stuck);
}

}  // namespace
}  // namespace lockstep
