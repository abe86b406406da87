// Lam C. Y. and P. Ehkan, "Design and Implementation of FPGA Based Bipolar Stepper Motor Controller for Linear Slide
// Application": the simulated run of Fig. 7, and the states of Fig. 3 on a slide with two switches.
#include <gtest/gtest.h>

#include <array>

#include "core/methods/lam.hpp"

namespace lockstep::methods {
namespace {

/// The slide: the position of the head in pulses, and a switch at each end.
struct Slide {
    std::int64_t head = 0;
    std::int64_t left_switch = 0;
    std::int64_t right_switch = 1'000;

    LamInputs inputs() const { return {.left_limit = head <= left_switch, .right_limit = head >= right_switch}; }
    void follow(const LamOutputs& outputs) {
        if (outputs.pulse) { head += outputs.right ? 1 : -1; }
    }
};

constexpr int kLongest = 1'000'000;  // clocks a test waits for a state

/// Runs until the state is reached. Returns false if it is not reached within kLongest clocks.
bool run_until(LamController& controller, Slide& slide, LamState state) {
    for (int i = 0; i < kLongest && controller.state() != state; ++i) {
        slide.follow(controller.clock(slide.inputs()));
    }
    return controller.state() == state;
}

void ask_for(LamController& controller, Slide& slide, std::int64_t destination) {
    LamInputs inputs = slide.inputs();
    inputs.data_ready = true;
    inputs.destination = destination;
    slide.follow(controller.clock(inputs));
}

/// The wait before a pulse of a move from 0, and the state of the controller meanwhile.
struct Wait {
    std::int64_t counts;
    LamState state;
};

std::vector<Wait> waits_to(std::int64_t destination) {
    LamController controller = LamController::standing_at(0);
    (void)controller.clock({.data_ready = true, .destination = destination});
    std::vector<Wait> waits;
    Wait wait{0, controller.state()};
    while (controller.state() != LamState::Standby) {
        wait.state = controller.state();
        ++wait.counts;
        if (controller.clock({}).pulse) {
            waits.push_back(wait);
            wait.counts = 0;
        }
    }
    EXPECT_EQ(controller.location(), destination);
    return waits;
}

TEST(LamFigure7, Destination328IsReachedExactly) {
    const auto waits = waits_to(328);
    EXPECT_EQ(waits.size(), 328U);
}

TEST(LamFigure7, FortySevenIntervalsAccelerateFrom100DownTo6) {
    const auto waits = waits_to(328);
    for (std::size_t i = 0; i < 47; ++i) {
        EXPECT_EQ(waits[i].counts, 100 - 2 * static_cast<std::int64_t>(i));
        EXPECT_EQ(waits[i].state, LamState::Accelerate);
    }
    EXPECT_EQ(waits[47].counts, 6);
    EXPECT_EQ(waits[47].state, LamState::Cruise);
    EXPECT_NEAR(LamParameters{}.clock_hz / 6, 1'666.67, 0.01);
}

TEST(LamFigure7, TheLastFivePulsesDecelerateBy10CountsEachUntil44OrMore) {
    const auto waits = waits_to(328);
    EXPECT_EQ(waits[322].state, LamState::Cruise);
    const std::array<std::int64_t, 5> expected{16, 26, 36, 46, 46};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(waits[323 + i].counts, expected[i]);
        EXPECT_EQ(waits[323 + i].state, LamState::Decelerate);
    }
}

TEST(LamStates, Destinations1To10ShorterThanTheDecelerationEndExactly) {
    for (std::int64_t destination = 1; destination <= 10; ++destination) {
        EXPECT_EQ(waits_to(destination).size(), static_cast<std::size_t>(destination));
    }
}

TEST(LamFigure3, PowerUpFindsTheLeftSwitchZeroesThereAndWaitsAtThePredefinedPlace) {
    LamController controller;
    Slide slide{.head = 37};
    EXPECT_EQ(controller.state(), LamState::Initialize);
    ASSERT_TRUE(run_until(controller, slide, LamState::Stop));
    EXPECT_EQ(slide.head, slide.left_switch);
    ASSERT_TRUE(run_until(controller, slide, LamState::Decelerate));
    ASSERT_TRUE(run_until(controller, slide, LamState::Standby));
    EXPECT_EQ(controller.location(), LamParameters{}.home_pulses);
    EXPECT_EQ(slide.head, LamParameters{}.home_pulses);
}

TEST(LamFigure3, ADestinationToTheLeftOfThePresentOneIsReachedToo) {
    LamController controller = LamController::standing_at(0);
    Slide slide{.left_switch = -1};
    for (const std::int64_t destination : {328, 100, 107, 3}) {
        ask_for(controller, slide, destination);
        ASSERT_TRUE(run_until(controller, slide, LamState::Standby));
        EXPECT_EQ(controller.location(), destination);
        EXPECT_EQ(slide.head, destination);
    }
}

/// Drives into a switch. The pulses must stop at once, and the axis must find its origin again.
void expect_recovery(std::int64_t from, std::int64_t destination, const Slide& at) {
    LamController controller = LamController::standing_at(from);
    Slide slide = at;
    slide.head = from;
    ask_for(controller, slide, destination);
    ASSERT_TRUE(run_until(controller, slide, LamState::Standby));
    const std::int64_t stopped_at = slide.head;
    EXPECT_TRUE(stopped_at == slide.left_switch || stopped_at == slide.right_switch);
    for (std::int64_t i = 0; i + 1 < LamParameters{}.recovery_delay; ++i) {
        slide.follow(controller.clock(slide.inputs()));
    }
    EXPECT_EQ(slide.head, stopped_at);
    EXPECT_EQ(controller.state(), LamState::Standby);
    ASSERT_TRUE(run_until(controller, slide, LamState::Stop));
    ASSERT_TRUE(run_until(controller, slide, LamState::Standby));
    EXPECT_EQ(slide.head, slide.left_switch + LamParameters{}.home_pulses);
}

TEST(LamFigure3, TheRightLimitStopsPulsesAtOnceAndAfterADelayTheAxisInitializes) {
    expect_recovery(50, 500, {.right_switch = 300});
}

TEST(LamFigure3, TheLeftLimitStopsPulsesAtOnceAndAfterADelayTheAxisInitializes) {
    expect_recovery(200, 20,
                    {.left_switch = 100});  // the count was wrong: the switch is nearer than the count indicates
}

TEST(LamMethod, RefusesOrApproximatesImpossibleMovesWithAReason) {
    const StepMove move{328, 100, 1'667, 4'200, 4'200};
    EXPECT_NE(lam(move, Fit::Exact).error().nearest.find("a fixed acceleration"), std::string::npos);
    const auto train = lam(move, Fit::Nearest);
    ASSERT_TRUE(train.has_value());
    EXPECT_EQ(train->times_s.size(), 328U);
    EXPECT_DOUBLE_EQ(train->times_s.front(), 0.01);  // 100 Hz
}

}  // namespace
}  // namespace lockstep::methods
