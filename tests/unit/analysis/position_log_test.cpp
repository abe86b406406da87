#include "clients/analysis/measure/position_log.hpp"

#include <gtest/gtest.h>

#include "tests/unit/axis/pair_machine.hpp"

namespace lockstep::analysis {
namespace {

/// The log has steps until tick 1000, where the axis is at 50.
constexpr StepsEnd kSteps{.tick = Tick{1000}, .position_steps = 50};

TEST(PositionLog, CountsTheStepsThatALaterPositionShows) {
    PositionLog log;
    log.take({.tick = Tick{900}, .steps = 45}, kSteps);
    EXPECT_EQ(log.unrecorded_steps(kSteps), 0);
    log.take({.tick = Tick{1100}, .steps = 53}, kSteps);
    EXPECT_EQ(log.unrecorded_steps(kSteps), 3);
}

TEST(PositionLog, RemembersThatTheAxisWentAwayAndCameBack) {
    PositionLog log;
    log.take({.tick = Tick{1100}, .steps = 57}, kSteps);
    log.take({.tick = Tick{1200}, .steps = 50}, kSteps);
    EXPECT_EQ(log.unrecorded_steps(kSteps), 7);
    log.take_steps(Tick{1150});
    EXPECT_EQ(log.unrecorded_steps({.tick = Tick{1150}, .position_steps = 50}), 0);
}

TEST(PositionLog, CountsFromANewZeroUntilStepsWithItAreRecorded) {
    PositionLog log;
    log.take({.tick = Tick{1050}, .steps = 50}, kSteps);
    log.take({.tick = Tick{1100}, .steps = 0, .is_homed = true}, kSteps);
    log.take({.tick = Tick{1200}, .steps = 4, .is_homed = true}, kSteps);
    EXPECT_EQ(log.unrecorded_steps(kSteps), 4);
    log.take_steps(Tick{1200});
    EXPECT_EQ(log.unrecorded_steps({.tick = Tick{1200}, .position_steps = 4}), 0);
}

/// The motor takes the place of its encoder at rest, and goes back by its own steps.
TEST(PositionLog, CountsLostStepsThatAreMadeUp) {
    PositionLog log;
    const auto homed = [&](std::int64_t tick, std::int64_t steps, std::int64_t error) {
        log.take({.tick = Tick{tick}, .steps = steps, .is_homed = true, .following_error = error}, kSteps);
    };
    homed(1100, 50, 0);
    homed(1200, 50, -5);
    EXPECT_EQ(log.corrected_steps(), 0);
    homed(1300, 45, 0);
    EXPECT_EQ(log.corrected_steps(), 5);
    EXPECT_EQ(log.unrecorded_steps(kSteps), 0) << "the new zero is no motion";
    homed(1400, 47, 0);
    EXPECT_EQ(log.unrecorded_steps(kSteps), 2);
}

/// A hand pushes the slide and takes it back.
TEST(PositionLog, TakesNoErrorThatVanishesForACorrection) {
    PositionLog log;
    log.take({.tick = Tick{1100}, .steps = 50, .is_homed = true, .following_error = 5}, kSteps);
    log.take({.tick = Tick{1200}, .steps = 50, .is_homed = true}, kSteps);
    EXPECT_EQ(log.corrected_steps(), 0);
}

/// X of this machine homes in place, at 5 mm.
TEST(PositionLog, CountsFromAHomingInPlaceAgain) {
    MachineConfig machine = pair_machine();
    machine.axes[0].homing.way = HomingWay::InPlace;
    PositionLog log;
    log.set_machine(machine, "X");
    const auto homed = [&](std::int64_t tick, std::int64_t steps) {
        log.take({.tick = Tick{tick}, .steps = steps, .is_homed = true}, kSteps);
    };
    homed(1100, 50);
    homed(1200, 500);
    EXPECT_EQ(log.unrecorded_steps(kSteps), 0);
    homed(1300, 502);
    EXPECT_EQ(log.unrecorded_steps(kSteps), 2);
}

TEST(PositionLog, FindsTheStepsPerMm) {
    PositionLog log;
    EXPECT_FALSE(log.steps_per_mm());
    log.take({.tick = Tick{1100}, .steps = -200, .mm = -2}, kSteps);
    EXPECT_DOUBLE_EQ(log.steps_per_mm().value(), 100);
}

}  // namespace
}  // namespace lockstep::analysis
