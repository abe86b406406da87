// sim_fpga/rtl/lam beside LamController, clock by clock: the run of Lam's Fig. 7, and drawn slides with drawn
// destinations, switches that close anywhere, and requests at any time.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "Vlam_controller.h"
#include "core/methods/lam_controller.hpp"
#include "tests/rtl/clocked.hpp"

namespace lockstep::rtl {
namespace {

using methods::LamController;
using methods::LamInputs;
using methods::LamOutputs;
using methods::LamState;

/// The hardware and the C++, which get the same inputs.
class Pair {
public:
    Pair() { hardware_.reset(); }

    /// One clock of both. Returns false where they differ.
    bool clock(const LamInputs& inputs) {
        auto& pins = hardware_.pins;
        pins.left_limit = inputs.left_limit;
        pins.right_limit = inputs.right_limit;
        pins.data_ready = inputs.data_ready;
        pins.destination = static_cast<std::uint16_t>(inputs.destination);
        hardware_.clock();
        outputs_ = software_.clock(inputs);
        return equal();
    }
    LamState state() const { return software_.state(); }
    LamOutputs outputs() const { return outputs_; }
    std::int64_t location() const { return software_.location(); }

private:
    bool equal() const {
        const auto& pins = hardware_.pins;
        return (pins.pulse != 0) == outputs_.pulse && (!outputs_.pulse || (pins.right != 0) == outputs_.right) &&
               pins.state == static_cast<int>(software_.state()) &&
               static_cast<std::int16_t>(pins.location) == software_.location() && pins.delay == software_.delay();
    }

    Clocked<Vlam_controller> hardware_;
    LamController software_;
    LamOutputs outputs_;
};

struct Slide {
    std::int64_t head = 0;
    std::int64_t right_switch = 1'000;

    LamInputs inputs() const { return {.left_limit = head <= 0, .right_limit = head >= right_switch}; }
    void follow(const LamOutputs& outputs) {
        if (outputs.pulse) { head += outputs.right ? 1 : -1; }
    }
};

constexpr int kLongest = 200'000;  // clocks until the head stands by

/// Clocks both until they stand by, and the clocks of the pulses.
std::vector<int> pulses_until_standby(Pair& pair, Slide& slide) {
    std::vector<int> pulses;
    for (int clock = 1; clock <= kLongest; ++clock) {
        EXPECT_TRUE(pair.clock(slide.inputs())) << "clock " << clock;
        slide.follow(pair.outputs());
        if (pair.outputs().pulse) { pulses.push_back(clock); }
        if (pair.state() == LamState::Standby || testing::Test::HasFailure()) { break; }
    }
    return pulses;
}

TEST(LamHardware, MakesThe328PulsesOfFigure7AtTheClocksOfTheSoftware) {
    Pair pair;
    Slide slide{.head = 5};
    (void)pulses_until_standby(pair, slide);
    ASSERT_EQ(pair.location(), 50);
    LamInputs request = slide.inputs();
    request.data_ready = true;
    request.destination = 378;
    ASSERT_TRUE(pair.clock(request));
    const auto pulses = pulses_until_standby(pair, slide);
    ASSERT_EQ(pulses.size(), 328U);
    EXPECT_EQ(slide.head, 378);
    EXPECT_EQ(pulses[0], 100);
    EXPECT_EQ(pulses[47] - pulses[46], 6);
    EXPECT_EQ(pulses[327] - pulses[326], 46);
}

/// A destination on the slide or shortly beyond its right end, often a short way off.
std::int64_t destination(std::mt19937_64& draw, const Slide& slide, std::int64_t location) {
    if (draw() % 3 == 0) { return std::max<std::int64_t>(0, location + static_cast<std::int64_t>(draw() % 25) - 12); }
    return static_cast<std::int64_t>(draw() % static_cast<std::uint64_t>(slide.right_switch + 20));
}

TEST(LamHardware, EqualsTheSoftwareInEveryClockOnDrawnSlides) {
    std::mt19937_64 draw(1);
    int moves = 0;
    int limits = 0;
    for (int round = 0; round < 60; ++round) {
        Pair pair;
        Slide slide{.head = static_cast<std::int64_t>(draw() % 200),
                    .right_switch = 60 + static_cast<std::int64_t>(draw() % 900)};
        for (int clock = 0; clock < 100'000; ++clock) {
            LamInputs inputs = slide.inputs();
            if (draw() % 200 == 0) {
                inputs.data_ready = true;
                inputs.destination = destination(draw, slide, pair.location());
            }
            if (draw() % 20'000 == 0) { (draw() % 2 == 0 ? inputs.left_limit : inputs.right_limit) = true; }
            const LamState before = pair.state();
            ASSERT_TRUE(pair.clock(inputs)) << "round " << round << ", clock " << clock;
            slide.follow(pair.outputs());
            moves += before == LamState::Standby && pair.state() >= LamState::Accelerate ? 1 : 0;
            limits += before == LamState::Standby && pair.state() == LamState::Initialize ? 1 : 0;
        }
    }
    EXPECT_GT(moves, 500);
    EXPECT_GT(limits, 100);
}

}  // namespace
}  // namespace lockstep::rtl
