// A host grants a service's requests, or the service reports the effect of the refusal. It runs either way.
#include "services/runtime/real_time.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace lockstep {
namespace {

/// Asks in a thread of its own, because the settings end with the thread.
std::vector<std::string> ask(const RealTimeConfig& wanted) {
    std::vector<std::string> lines;
    std::thread([&] { lines = ask_for_real_time(wanted); }).join();
    return lines;
}

TEST(RealTime, RequestsNothingUnlessConfigured) { EXPECT_TRUE(ask({}).empty()); }

TEST(RealTime, ReportsTheResultForSchedulerAndMemory) {
    const auto lines = ask({.priority = 1});
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_TRUE(lines[0].starts_with("scheduler FIFO, priority 1") || lines[0].contains("to allow it: LimitRTPRIO"));
    EXPECT_TRUE(lines[1] == "memory locked" || lines[1].contains("to allow it: LimitMEMLOCK"));
}

TEST(RealTime, AProcessorThatTheHostLacksIsNamed) {
    EXPECT_EQ(ask({.cpus = {0}}).front(), "runs on processors 0");
    EXPECT_TRUE(ask({.cpus = {1023}}).front().starts_with("runs on any processor: 1023 was refused"));
}

}  // namespace
}  // namespace lockstep
