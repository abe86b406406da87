// Freed large blocks are returned to the system, also after earlier large blocks were freed.
#include "services/runtime/heap.hpp"

#include <gtest/gtest.h>
#include <malloc.h>

#include <vector>

namespace lockstep {
namespace {

constexpr std::size_t kLarge = 256 << 10;

std::size_t mapped_bytes() { return mallinfo2().hblkhd; }

TEST(Heap, LargeBlocksAreMappedAlsoAfterOneWasFreed) {
    give_back_large_blocks();
    for (int round = 0; round < 3; ++round) {
        const std::size_t before = mapped_bytes();
        {
            const std::vector<char> block(kLarge);
            EXPECT_GE(mapped_bytes(), before + block.size()) << "round " << round;
        }
        EXPECT_EQ(mapped_bytes(), before) << "round " << round;
    }
}

}  // namespace
}  // namespace lockstep
