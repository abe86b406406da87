// What a service asks of its host is granted, or it is said what that costs; it runs either way.
#include "services/runtime/real_time.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace lockstep {
namespace {

/// In a thread: its scheduler and its processors go with it.
std::vector<std::string> ask(const RealTimeConfig& wanted) {
    std::vector<std::string> said;
    std::thread([&] { said = ask_for_real_time(wanted); }).join();
    return said;
}

TEST(RealTime, AsksForNothingUnlessItIsConfigured) { EXPECT_TRUE(ask({}).empty()); }

TEST(RealTime, SaysWhatCameOfSchedulerAndMemory) {
    const auto said = ask({.priority = 1});
    ASSERT_EQ(said.size(), 2U);
    EXPECT_TRUE(said[0].starts_with("scheduler FIFO, priority 1") || said[0].contains("to permit it: LimitRTPRIO"));
    EXPECT_TRUE(said[1] == "memory locked" || said[1].contains("to permit it: LimitMEMLOCK"));
}

TEST(RealTime, AProcessorThatTheHostLacksIsNamed) {
    EXPECT_EQ(ask({.cpus = {0}}).front(), "runs on processors 0");
    EXPECT_TRUE(ask({.cpus = {1023}}).front().starts_with("runs on any processor: 1023 was refused"));
}

}  // namespace
}  // namespace lockstep
