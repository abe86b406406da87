// The firmware's arithmetic equals that of 128 bits, and its engine the tick-by-tick form.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "core/step/executable.hpp"
#include "core/step/tick_engine.hpp"
#include "sim_fpga/firmware/device/engine.hpp"
#include "sim_fpga/firmware/device/wide.hpp"
#include "tests/property/step/random_segment.hpp"

namespace lockstep::testing {
namespace {

Int128 value_of(firmware::Wide wide) { return static_cast<Int128>(UInt128{wide.high} << 64 | wide.low); }

firmware::Piece words_of(const Piece& piece) {
    return {.ticks = piece.ticks.value,
            .velocity = static_cast<std::uint64_t>(piece.velocity.raw),
            .acceleration = static_cast<std::uint64_t>(piece.acceleration.raw)};
}

TEST(FirmwareEngine, AddsAndMultipliesWordsExactly) {
    std::mt19937_64 random(1);
    for (int trial = 0; trial < 100'000; ++trial) {
        const auto value = static_cast<std::int64_t>(random()) >> random() % 64;
        const auto times = static_cast<std::int64_t>(random() >> 1 >> random() % 63);
        const firmware::Wide product = firmware::product_of(value, times);
        const Int128 exact = Int128{value} * times;
        ASSERT_TRUE(value_of(product) == exact);
        ASSERT_TRUE(value_of(product + firmware::widened(value)) == exact + value);
        ASSERT_EQ(firmware::is_narrow(product), exact == static_cast<std::int64_t>(exact));
        ASSERT_EQ(firmware::is_negative(product), exact < 0);
    }
}

TEST(FirmwareEngine, AcceptsExactlyThePiecesThatTheStepEngineExecutes) {
    RandomSegments segments(2);
    for (int trial = 0; trial < 100'000; ++trial) {
        Piece piece = segments.next(44).piece;
        piece.ticks.value += segments.below(5) - 2;
        piece.velocity.raw ^= segments.one_in(2) ? 0 : segments.below(std::int64_t{1} << 62);
        ASSERT_EQ(firmware::is_executable(words_of(piece)), piece.ticks >= Ticks{1} && executable(piece));
    }
}

/// Half of the runs pause after a step, as at a switch.
TEST(FirmwareEngine, MakesTheStepsOfTheTickByTickForm) {
    RandomSegments segments(3);
    for (int trial = 0; trial < 3000; ++trial) {
        const Segment segment = segments.next(11);
        std::vector<StepEdge> expected;
        tick_by_tick(segment, [&](StepEdge edge) { expected.push_back(edge); });
        std::vector<StepEdge> made;
        firmware::Engine engine(segment.start.value);
        engine.rebase({segment.from.count(), segment.from.phase()});
        engine.begin(words_of(segment.piece));
        while (!engine.is_idle()) {
            engine.run(engine.now() + 1 + segments.below(100), [&](const firmware::StepBlock& block) {
                const bool pauses = segments.one_in(2);
                const auto most = static_cast<std::uint32_t>(segments.below(block.size));
                const std::uint32_t steps = pauses ? 1 + most : block.size;
                for (std::uint32_t n = 0; n < steps; ++n) {
                    made.push_back({Tick{block.tick(n)}, static_cast<std::int8_t>(block.direction)});
                }
                return firmware::TakenSteps{steps, pauses};
            });
        }
        ASSERT_TRUE(made == expected) << "trial " << trial;
        ASSERT_EQ(engine.place(), (firmware::Place{segment.to().count(), segment.to().phase()}));
    }
}

}  // namespace
}  // namespace lockstep::testing
