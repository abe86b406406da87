#include "clients/session/chunked_program.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace lockstep {
namespace {

using namespace std::chrono_literals;

std::vector<std::uint8_t> some_bytes(std::size_t size) {
    std::vector<std::uint8_t> bytes(size);
    std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
    return bytes;
}

TEST(ChunkedProgram, ArrivesWholeAndInChunksNoLargerThanAllowed) {
    const auto bytes = some_bytes(2 * kChunkBytes + 5);
    ChunkedProgram program(7, 100, 42, bytes);
    std::vector<std::uint8_t> arrived;
    for (const ProgramChunk& chunk : program.due(0ns)) {
        EXPECT_EQ(chunk.client, 7u);
        EXPECT_EQ(chunk.program, 42u);
        EXPECT_EQ(chunk.count, 3u);
        EXPECT_EQ(chunk.sequence, 100u + chunk.index);
        EXPECT_LE(chunk.bytes.size(), kChunkBytes);
        arrived.insert(arrived.end(), chunk.bytes.begin(), chunk.bytes.end());
        program.take_answer(chunk.sequence);
    }
    EXPECT_EQ(arrived, bytes);
    EXPECT_TRUE(program.done());
}

TEST(ChunkedProgram, OfWholeChunksHasNoEmptyOne) {
    EXPECT_EQ(ChunkedProgram(1, 1, 1, some_bytes(2 * kChunkBytes)).count(), 2u);
}

TEST(ChunkedProgram, WithoutBytesIsOneEmptyChunk) {
    ChunkedProgram program(1, 1, 1, {});
    ASSERT_EQ(program.due(0ns).size(), 1u);
    program.take_answer(1);
    EXPECT_TRUE(program.done());
}

TEST(ChunkedProgram, KeepsAFewInFlightAndSendsTheNextWhenOneIsAnswered) {
    ChunkedProgram program(1, 1, 1, some_bytes(40 * kChunkBytes));
    EXPECT_EQ(program.due(0ns).size(), kChunksInFlight);
    EXPECT_TRUE(program.due(1ms).empty());
    program.take_answer(3);
    const auto next = program.due(2ms);
    ASSERT_EQ(next.size(), 1u);
    EXPECT_EQ(next[0].index, kChunksInFlight);
}

TEST(ChunkedProgram, RepeatsUnansweredChunks) {
    ChunkedProgram program(1, 1, 1, some_bytes(3 * kChunkBytes));
    (void)program.due(0ns);
    program.take_answer(1);
    program.take_answer(3);
    EXPECT_TRUE(program.due(kRepeatAfter - 1ns).empty());
    const auto again = program.due(kRepeatAfter);
    ASSERT_EQ(again.size(), 1u);
    EXPECT_EQ(again[0].index, 1u);
}

TEST(ChunkedProgram, CountsOnlyItsOwnAnswersOnce) {
    ChunkedProgram program(1, 10, 1, some_bytes(2 * kChunkBytes));
    (void)program.due(0ns);
    for (const std::uint64_t sequence : {9, 10, 10, 12, 0}) { program.take_answer(sequence); }
    EXPECT_EQ(program.answered(), 1u);
    EXPECT_FALSE(program.done());
}

}  // namespace
}  // namespace lockstep
