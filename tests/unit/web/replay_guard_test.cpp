// Idempotency keys.
#include "clients/web/api/replay_guard.hpp"

#include <gtest/gtest.h>

namespace lockstep::web {
namespace {

using namespace std::chrono_literals;

TEST(ReplayGuard, AKeyIsUsedOnceInTenMinutes) {
    ReplayGuard guard;
    EXPECT_TRUE(guard.use("a", 0s));
    EXPECT_FALSE(guard.use("a", 0s));
    EXPECT_TRUE(guard.use("b", 0s));
    EXPECT_FALSE(guard.use("a", 600s));
    EXPECT_TRUE(guard.use("a", 601s));
}

TEST(ReplayGuard, ARefusedReplayDoesNotProlongItsKey) {
    ReplayGuard guard;
    (void)guard.use("a", 0s);
    (void)guard.use("a", 599s);
    EXPECT_TRUE(guard.use("a", 601s));
}

TEST(ReplayGuard, ForgetsTheOldestFirst) {
    ReplayGuard guard;
    for (std::size_t i = 0; i <= ReplayGuard::kMostKeys; ++i) { ASSERT_TRUE(guard.use(std::to_string(i), 0s)); }
    EXPECT_FALSE(guard.use(std::to_string(ReplayGuard::kMostKeys), 0s));
    EXPECT_TRUE(guard.use("0", 0s)) << "bounded memory";
}

}  // namespace
}  // namespace lockstep::web
