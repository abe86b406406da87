// The places at which motors rest whose pulses had to cease at a touch.
#include "core/coordinator/epoch/touch_place.hpp"

#include <gtest/gtest.h>

#include "tests/unit/axis/pair_machine.hpp"

namespace lockstep {
namespace {

constexpr Tick kTouched{50'000};
constexpr std::int64_t kStepTicks = 200;            // X makes a step in these
constexpr std::int64_t kDue = 51'000 / kStepTicks;  // where it is after the debounce of 1 ms

MachineConfig machine_with_probe() {
    MachineConfig machine = pair_machine();
    for (const char* motor : {"X", "Y"}) {
        machine.inputs.push_back({.name = std::string("probe_") + motor,
                                  .motor = motor,
                                  .channel = 3,
                                  .use = InputUse::Probe,
                                  .number = 0,
                                  .wire = "tip"});
    }
    return machine;
}

TouchInputs both(bool ceases = true) {
    return {.any_of = {{MotorIndex{0}, 3}, {MotorIndex{1}, 3}}, .opens = false, .ceases = ceases};
}

/// X goes up, Y goes down at half its speed.
MotorPositions places_at(Tick tick) {
    return {Position::steps(tick.value / kStepTicks), Position::steps(-tick.value / (2 * kStepTicks))};
}

const RunFrames kRan{Tick{}, places_at};

std::optional<OffTouch> off(std::int64_t x, std::int64_t y, const MachineConfig& machine = machine_with_probe()) {
    return off_touch(machine, both(), kTouched, kRan, {Position::steps(x), Position::steps(y)});
}

TEST(TouchPlace, IsThatOfTheFramesAtTheTouchAndTheDebounce) {
    EXPECT_FALSE(off(kDue, -kDue / 2));
    EXPECT_FALSE(off(kDue - 1, -kDue / 2)) << "a tick earlier, before the step";
    EXPECT_TRUE(off(kDue - 2, -kDue / 2));
    EXPECT_TRUE(off(kDue + 1, -kDue / 2));
}

TEST(TouchPlace, NamesTheMotorThatWentOnAndWhereItHadToRest) {
    const auto found = off(kDue, -200);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->motor, MotorIndex{1});
    EXPECT_EQ(found->rests, -200);
    EXPECT_EQ(found->due, -kDue / 2);
}

TEST(TouchPlace, IsKnownWithinTheErrorsOfEstimatedClocks) {
    MachineConfig machine = machine_with_probe();
    machine.timing.time_source = TimeSource::Network;
    machine.timing.clock_error_limit_us = 250;
    EXPECT_FALSE(off(kDue + 2, -kDue / 2, machine));
    EXPECT_TRUE(off(kDue + 4, -kDue / 2, machine));
}

TEST(TouchPlace, IsAnyIfTheTouchWasBeforeTheFrames) {
    const RunFrames later{kTouched + Ticks{1}, places_at};
    const MotorPositions elsewhere{Position::steps(1000), Position::steps(1000)};
    EXPECT_FALSE(off_touch(machine_with_probe(), both(), kTouched, later, elsewhere));
    EXPECT_TRUE(off_touch(machine_with_probe(), both(), kTouched, {kTouched, places_at}, elsewhere));
}

TEST(TouchPlace, IsAnyIfTheTouchCeasesNoPulses) {
    const MotorPositions elsewhere{Position::steps(1000), Position::steps(1000)};
    EXPECT_FALSE(off_touch(machine_with_probe(), both(false), kTouched, kRan, elsewhere));
}

}  // namespace
}  // namespace lockstep
