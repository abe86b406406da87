#include "core/axis/step_lateness.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace lockstep {
namespace {

constexpr Velocity kStepEach100Ticks{static_cast<std::int64_t>(kOneStep / 100)};

/// A steady run of `steps` steps, one every 100 ticks.
ExecutedTrack steady(Tick start, std::int64_t steps) {
    return {.start = start, .from = Position::steps(0), .pieces = {{{100 * steps}, kStepEach100Ticks, {}}}};
}

std::vector<StepEdge> planned_steps(const ExecutedTrack& track) {
    std::vector<StepEdge> steps;
    for_each_step({track.start, track.from, track.pieces[0]}, [&](StepEdge step) { steps.push_back(step); });
    return steps;
}

std::vector<std::int64_t> latenesses(StepLateness& lateness, const ExecutedTrack& track) {
    std::vector<std::int64_t> all;
    lateness.ran(track, [&](Ticks late) { all.push_back(late.value); });
    return all;
}

TEST(StepLateness, IsNoneWhereTheDeviceMadeWhatWasPlanned) {
    StepLateness lateness;
    const ExecutedTrack track = steady({1'000'000}, 5);
    for (const StepEdge step : planned_steps(track)) { lateness.made(step); }
    EXPECT_EQ(latenesses(lateness, track), (std::vector<std::int64_t>{0, 0, 0, 0, 0}));
}

TEST(StepLateness, IsEachStepsOwn) {
    StepLateness lateness;
    const ExecutedTrack track = steady({1'000'000}, 3);
    std::int64_t late = -2;
    for (const StepEdge step : planned_steps(track)) { lateness.made({step.tick + Ticks{late++}, step.direction}); }
    EXPECT_EQ(latenesses(lateness, track), (std::vector<std::int64_t>{-2, -1, 0}));
}

TEST(StepLateness, LeavesTheNextTracksStepsToIt) {
    StepLateness lateness;
    const ExecutedTrack first = steady({1'000'000}, 2);
    const ExecutedTrack second = steady({1'000'200}, 2);
    for (const ExecutedTrack& track : {first, second}) {
        for (const StepEdge step : planned_steps(track)) { lateness.made(step); }
    }
    EXPECT_EQ(latenesses(lateness, first).size(), 2U);
    EXPECT_EQ(latenesses(lateness, second), (std::vector<std::int64_t>{0, 0}));
}

TEST(StepLateness, EndsWhereTheRunWasCut) {
    StepLateness lateness;
    const ExecutedTrack track = steady({1'000'000}, 5);
    for (const StepEdge step : planned_steps(track)) {
        if (step.tick < Tick{1'000'300}) { lateness.made(step); }
    }
    const ExecutedTrack next = steady({2'000'000}, 2);
    EXPECT_EQ(latenesses(lateness, track).size(), 3U);
    for (const StepEdge step : planned_steps(next)) { lateness.made(step); }
    EXPECT_EQ(latenesses(lateness, next), (std::vector<std::int64_t>{0, 0}));
}

TEST(StepLateness, StepsWaitUntilTheRingIsFullHoweverManyCameBefore) {
    constexpr auto kMost = static_cast<std::int64_t>(StepLateness::kMaxWaiting);
    StepLateness lateness;
    const ExecutedTrack first = steady({1'000'000}, kMost / 2);
    const ExecutedTrack second = steady({1'000'000 + 100 * kMost / 2}, kMost);
    for (const ExecutedTrack& track : {first, second}) {
        for (const StepEdge step : planned_steps(track)) { lateness.made(step); }
        EXPECT_EQ(latenesses(lateness, track), std::vector<std::int64_t>(planned_steps(track).size(), 0));
    }
}

TEST(StepLateness, OfStepsThatAreNotThePlansIsNotGuessed) {
    StepLateness lateness;
    const ExecutedTrack track = steady({1'000'000}, 3);
    for (const StepEdge step : planned_steps(track)) { lateness.made({step.tick, -1}); }
    EXPECT_TRUE(latenesses(lateness, track).empty());
}

}  // namespace
}  // namespace lockstep
