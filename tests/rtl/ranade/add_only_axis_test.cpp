// sim_fpga/rtl/ranade/add_only_axis.v beside the reference form of the engine, register by register, and beside
// Ranade's method (core/methods), step by step.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "Vadd_only_axis.h"
#include "core/methods/ranade.hpp"
#include "core/step/tick_engine.hpp"
#include "tests/property/step/random_segment.hpp"
#include "tests/rtl/clocked.hpp"

namespace lockstep::rtl {
namespace {

/// The axis and whoever gives it pieces. A tick has two clocks: in the first one it takes a piece.
class Axis {
public:
    Axis() { hardware_.reset(); }

    /// Executes a piece. Calls on_tick(step) after each tick: +1, -1 or 0.
    template <typename OnTick>
    void run(const Piece& piece, OnTick&& on_tick) {
        auto& pins = hardware_.pins;
        pins.next_valid = 1;
        pins.next_ticks = static_cast<std::uint32_t>(piece.ticks.value);
        pins.next_velocity = static_cast<std::uint64_t>(piece.velocity.raw);
        pins.next_acceleration = static_cast<std::uint64_t>(piece.acceleration.raw);
        for (std::int64_t i = 0; i < piece.ticks.value; ++i) {
            hardware_.clock();
            pins.next_valid = 0;
            on_tick(tick());
        }
    }
    int tick() {
        auto& pins = hardware_.pins;
        pins.tick = 1;
        hardware_.clock();
        pins.tick = 0;
        if (pins.step == 0) { return 0; }
        return pins.backward != 0 ? -1 : 1;
    }
    std::uint64_t phase() const { return hardware_.pins.phase_out; }
    std::uint64_t velocity() const { return hardware_.pins.velocity_out; }

private:
    Clocked<Vadd_only_axis> hardware_;
};

TEST(RanadeHardware, MakesThePulsesOfTable1) {
    constexpr std::int64_t kFifthOfAStepUp = 3689348814741910324;  // ceil(2^64 / 5)
    Axis axis;
    const Piece half_a_step_back{Ticks{1}, {std::numeric_limits<std::int64_t>::min()}, {}};
    axis.run(half_a_step_back, [](int step) { EXPECT_EQ(step, 0); });
    std::vector<int> pulses;
    int second = 0;
    axis.run({Ticks{27}, {kFifthOfAStepUp}, {}}, [&](int step) {
        ++second;
        if (step != 0) { pulses.push_back(second); }
    });
    EXPECT_EQ(pulses, (std::vector<int>{5, 10, 15, 20, 25}));
    EXPECT_EQ(axis.tick(), 0);  // at rest
}

TEST(RanadeHardware, HasTheRegistersOfTheReferenceAfterEveryTickOfDrawnPieces) {
    testing::RandomSegments draw(1);
    Axis axis;
    std::int64_t steps = 0;
    for (int i = 0; i < 40'000; ++i) {
        const Segment segment = draw.next(8);
        Accumulator reference(Position::from_count(0, axis.phase()), segment.piece);
        axis.run(segment.piece, [&](int step) {
            ASSERT_EQ(step, reference.tick());
            ASSERT_EQ(axis.phase(), reference.phase);
            ASSERT_EQ(axis.velocity(), reference.velocity);
            steps += std::abs(step);
        });
        if (::testing::Test::HasFatalFailure()) { return; }
    }
    EXPECT_GT(steps, 20'000);
}

methods::StepTrain made_by_hardware(const std::vector<Piece>& pieces) {
    methods::StepTrain train;
    Axis axis;
    std::int64_t now = 0;
    for (const Piece& piece : pieces) {
        axis.run(piece, [&](int step) {
            ++now;
            EXPECT_GE(step, 0);
            if (step > 0) { train.times_s.push_back(static_cast<double>(now) * methods::RanadeParameters{}.tick_s); }
        });
    }
    return train;
}

TEST(RanadeHardware, MakesEveryStepOfDrawnMovesInTheTickOfTheMethod) {
    std::mt19937_64 draw(2);
    const auto between = [&](double low, double high) {
        return low * std::pow(high / low, static_cast<double>(draw() % 1'000) / 1'000);
    };
    for (int i = 0; i < 60; ++i) {
        const double start = between(100, 5'000);
        const StepMove move{static_cast<std::int64_t>(between(1, 3'000)), start, start + between(100, 400'000),
                            between(1e4, 1e7), between(1e4, 1e7)};
        const auto pieces = methods::ranade_pieces(move);
        ASSERT_TRUE(pieces.has_value());
        const auto train = methods::ranade(move, methods::Fit::Exact);
        ASSERT_EQ(train->times_s.size(), static_cast<std::size_t>(move.steps));
        ASSERT_EQ(made_by_hardware(*pieces).times_s, train->times_s) << "move " << i;
    }
}

}  // namespace
}  // namespace lockstep::rtl
