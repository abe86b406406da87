#include "core/step/executable.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lockstep {
namespace {

constexpr std::int64_t kTop = std::numeric_limits<std::int64_t>::max();

TEST(Executable, IsEveryPieceWhoseVelocityStaysIn64Bits) {
    EXPECT_TRUE(executable({Ticks{0}, {kTop}, {kTop}}));
    EXPECT_TRUE(executable({Ticks{kTop / 1024 / 1024 / 8}, {0}, {1}}));
    EXPECT_TRUE(executable({Ticks{2}, {kTop}, {-kTop}}));
    EXPECT_TRUE(executable({Ticks{1}, {-1}, {-kTop}}));
}

TEST(Executable, RefusesPiecesFasterThanHalfAStepPerTick) {
    EXPECT_FALSE(executable({Ticks{1}, {kTop}, {1}}));
    EXPECT_FALSE(executable({Ticks{2}, {-2}, {-kTop}}));
    EXPECT_FALSE(executable({kMaxPieceTicks, {0}, {std::int64_t{1} << 21}}));
    EXPECT_TRUE(executable({kMaxPieceTicks, {-1}, {std::int64_t{1} << 21}}));
}

TEST(Executable, IsNoneOfNegativeOrEndlessDuration) {
    EXPECT_FALSE(executable({Ticks{-1}, {}, {}}));
    EXPECT_FALSE(executable({kMaxPieceTicks + Ticks{1}, {}, {}}));
}

}  // namespace
}  // namespace lockstep
