// A loop wakes at multiples of its period and skips missed periods.
#include "services/runtime/periodic.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <thread>
#include <vector>

#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

TEST(PeriodicLoop, WakesAtMultiplesOfItsPeriodAndNeverTwiceForOne) {
    StopSignal stop;
    PeriodicLoop loop(2ms);
    std::vector<std::chrono::nanoseconds> wakes;
    loop.run(stop, [&](std::chrono::nanoseconds wake) {
        EXPECT_GE(monotonic_now(), wake);
        EXPECT_EQ(wake % 2ms, 0ns);
        if (!wakes.empty()) { EXPECT_GT(wake, wakes.back()); }
        wakes.push_back(wake);
        if (wakes.size() == 5) { stop.request(); }
    });
    EXPECT_EQ(wakes.size(), 5u);
}

TEST(PeriodicLoop, SkipsAndCountsMissedPeriods) {
    StopSignal stop;
    PeriodicLoop loop(2ms);
    int runs = 0;
    loop.run(stop, [&](std::chrono::nanoseconds) {
        if (++runs == 1) { std::this_thread::sleep_for(9ms); }
        if (runs == 2) { stop.request(); }
    });
    EXPECT_EQ(runs, 2);
    EXPECT_GE(loop.skipped_periods(), 3u);
}

TEST(PeriodicLoop, EndsAtASignal) {
    const StopSignal stop;
    PeriodicLoop loop(1ms);
    int runs = 0;
    loop.run(stop, [&](std::chrono::nanoseconds) {
        if (++runs == 3) { kill(getpid(), SIGTERM); }
    });
    EXPECT_EQ(runs, 3);
}

TEST(MachineClock, CountsTicksOfTheMonotonicClock) {
    const MachineClock clock(2000);
    EXPECT_EQ(clock.tick_at(4999ns), Tick{2});
    EXPECT_EQ(clock.time_of({3}), 6us);
    EXPECT_EQ(clock.utime_of({500}), 1000);
    const Tick before = clock.now();
    const Tick after = clock.tick_at(monotonic_now());
    EXPECT_LE(before, after);
}

}  // namespace
}  // namespace lockstep
