#include "tests/benchmarks/step/many/edge_buffer.hpp"

#include <gtest/gtest.h>

#include <array>

namespace lockstep {
namespace {

TEST(EdgeBuffer, GivesBackTickAndDirection) {
    std::array<std::int64_t, EdgeBuffer::kSlack + 3> room{};
    EdgeBuffer edges(room);
    const auto free = edges.free();
    ASSERT_EQ(free.size(), 3U);
    free[0] = EdgeBuffer::pack(Tick{41}, false);
    free[1] = EdgeBuffer::pack(Tick{42}, true);
    free[2] = EdgeBuffer::pack(Tick{-43}, true);
    edges.filled(3);
    EXPECT_EQ(edges[0], (StepEdge{Tick{41}, 1}));
    EXPECT_EQ(edges[1], (StepEdge{Tick{42}, -1}));
    EXPECT_EQ(edges[2], (StepEdge{Tick{-43}, -1}));
    EXPECT_TRUE(edges.free().empty());
    edges.clear();
    EXPECT_EQ(edges.free().size(), 3U);
}

TEST(EdgeBuffer, HoldsNothingWithoutRoomBeyondTheSlack) {
    std::array<std::int64_t, 5> room{};
    EXPECT_TRUE(EdgeBuffer(room).free().empty());
    EXPECT_TRUE(EdgeBuffer().free().empty());
}

}  // namespace
}  // namespace lockstep
