// A process with a stop request ends, even if it waits for something that never happens.
#include "services/runtime/end_guard.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "services/runtime/service_options.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

class EndGuards : public testing::Test {
protected:
    void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

[[noreturn]] void end_with_a_thread_that_hangs() {
    StopSignal stop;
    const EndGuard guard(stop, 200ms);
    raise(SIGTERM);
    for (;;) { pause(); }  // like joining a thread that waits for a hung disk
}

TEST_F(EndGuards, EndAProcessThatWaitsForever) {
    EXPECT_EXIT(end_with_a_thread_that_hangs(), testing::ExitedWithCode(kServiceFailed), "a disk may hang");
}

constexpr int kOwnEnd = 42;

[[noreturn]] void end_without_a_request() {
    StopSignal stop;
    const EndGuard guard(stop, 100ms);
    std::this_thread::sleep_for(300ms);
    _exit(kOwnEnd);
}

TEST_F(EndGuards, DoNotEndAProcessWithoutAStopRequest) {
    EXPECT_EXIT(end_without_a_request(), testing::ExitedWithCode(kOwnEnd), "");
}

[[noreturn]] void end_in_time() {
    StopSignal stop;
    {
        const EndGuard guard(stop, 100ms);
        stop.request();
    }
    std::this_thread::sleep_for(300ms);
    _exit(kOwnEnd);
}

TEST_F(EndGuards, LeaveAProcessAloneThatEndsInTime) {
    EXPECT_EXIT(end_in_time(), testing::ExitedWithCode(kOwnEnd), "");
}

}  // namespace
}  // namespace lockstep
