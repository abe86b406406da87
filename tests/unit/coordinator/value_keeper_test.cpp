#include "core/coordinator/values/value_keeper.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

gcode::KeptValues with_x(double x) {
    gcode::KeptValues values;
    values.systems[0].origin[0] = x;
    return values;
}

JobEvent begun(std::uint64_t program) { return {.kind = JobEvent::Kind::Begun, .program_id = program}; }
JobEvent ended(std::uint64_t program, JobOutcome outcome) {
    return {.kind = JobEvent::Kind::Ended, .outcome = outcome, .program_id = program};
}

gcode::ProgramValues edit(double x) { return {.revision = 3, .after = with_x(x), .at_once = true}; }

TEST(ValueKeeper, AProgramsValuesAreTheMachinesAfterItsEnd) {
    ValueKeeper keeper(3, with_x(1));
    ASSERT_TRUE(keeper.accept(7, {3, with_x(2)}, {}));
    keeper.take(begun(7));
    EXPECT_EQ(keeper.values(), with_x(1));
    keeper.take(ended(7, JobOutcome::Done));
    EXPECT_EQ(keeper.values(), with_x(2));
    EXPECT_EQ(keeper.revision(), 4U);
}

TEST(ValueKeeper, AProgramThatWasStoppedOrFailedLeavesNone) {
    for (const JobOutcome outcome : {JobOutcome::Stopped, JobOutcome::Failed}) {
        ValueKeeper keeper(3, with_x(1));
        ASSERT_TRUE(keeper.accept(7, {3, with_x(2)}, {}));
        keeper.take(begun(7));
        keeper.take(ended(7, outcome));
        EXPECT_EQ(keeper.values(), with_x(1));
        EXPECT_EQ(keeper.revision(), 3U);
    }
}

TEST(ValueKeeper, AProgramOfAnotherRevisionIsRefused) {
    ValueKeeper keeper(3, with_x(1));
    EXPECT_FALSE(keeper.accept(7, {2, with_x(2)}, {}));
    EXPECT_FALSE(keeper.accept(8, {4, {}}, {}));
}

TEST(ValueKeeper, AProgramThatArrivedBeforeAChangeIsForgotten) {
    ValueKeeper keeper(3, with_x(1));
    ASSERT_TRUE(keeper.accept(7, {3, {}}, {}));
    ASSERT_TRUE(keeper.accept(8, edit(2), {}));
    EXPECT_EQ(keeper.values(), with_x(2));
    EXPECT_EQ(keeper.take_outdated(), std::vector<std::uint64_t>{7});
    EXPECT_TRUE(keeper.take_outdated().empty());
}

TEST(ValueKeeper, AnEditWhileAJobIsInProgressIsRefused) {
    ValueKeeper keeper(3, with_x(1));
    EXPECT_FALSE(keeper.accept(8, edit(2), {.has_job = true}));
    EXPECT_EQ(keeper.values(), with_x(1));
}

TEST(ValueKeeper, InAPauseAPersonMayTouchOff) {
    ValueKeeper keeper(3, with_x(1));
    ASSERT_TRUE(keeper.accept(7, {3, {}}, {}));
    keeper.take(begun(7));
    ASSERT_TRUE(keeper.accept(8, edit(2), {.has_job = true, .is_paused = true}));
    EXPECT_EQ(keeper.values(), with_x(2));
    keeper.take(ended(7, JobOutcome::Done));
    EXPECT_EQ(keeper.values(), with_x(2));
}

TEST(ValueKeeper, OnlyWhatTheProgramItselfChangedReplacesAChangeInItsPause) {
    ValueKeeper keeper(3, with_x(1));
    gcode::KeptValues left = with_x(1);
    left.systems[1].origin[1] = 5;
    left.tools[4].diameter = 6;
    ASSERT_TRUE(keeper.accept(7, {3, left}, {}));
    keeper.take(begun(7));
    ASSERT_TRUE(keeper.accept(8, edit(2), {.has_job = true, .is_paused = true}));
    keeper.take({.kind = JobEvent::Kind::Begun, .job_kind = JobKind::Jog});
    keeper.take({.kind = JobEvent::Kind::Ended, .job_kind = JobKind::Jog});
    keeper.take(ended(7, JobOutcome::Done));
    EXPECT_EQ(keeper.values().systems[0].origin[0], 2) << "touched off in the pause";
    EXPECT_EQ(keeper.values().systems[1].origin[1], 5) << "by the program";
    EXPECT_EQ(keeper.values().tools.at(4).diameter, 6);
}

TEST(ValueKeeper, AProgramThatArrivedDuringAJobIsForgottenIfTheJobChangesTheValues) {
    ValueKeeper keeper(3, with_x(1));
    ASSERT_TRUE(keeper.accept(7, {3, with_x(2)}, {}));
    keeper.take(begun(7));
    ASSERT_TRUE(keeper.accept(8, {3, {}}, {.has_job = true}));
    EXPECT_TRUE(keeper.take_outdated().empty());
    keeper.take(ended(7, JobOutcome::Done));
    EXPECT_EQ(keeper.take_outdated(), (std::vector<std::uint64_t>{7, 8}));
}

TEST(ValueKeeper, TheSameValuesAreNoNewRevision) {
    ValueKeeper keeper(3, with_x(1));
    ASSERT_TRUE(keeper.accept(8, edit(1), {}));
    EXPECT_EQ(keeper.revision(), 3U);
    EXPECT_EQ(keeper.changes(), 0U);
}

TEST(ValueKeeper, AStandbyTakesTheOwnersValuesAlsoIfItsOwnHaveTheSameRevision) {
    ValueKeeper keeper(3, with_x(1));
    keeper.follow(3, with_x(1));
    EXPECT_EQ(keeper.changes(), 0U);
    keeper.follow(3, with_x(5));
    EXPECT_EQ(keeper.values(), with_x(5));
    EXPECT_EQ(keeper.changes(), 1U);
}

TEST(ValueKeeper, AfterATakeoverAProgramThatOnlyTheStandbyAcceptedIsForgotten) {
    ValueKeeper keeper(3, with_x(1));
    ASSERT_TRUE(keeper.accept(7, {2, {}}, {.owns_machine = false})) << "the owner refuses it";
    ASSERT_TRUE(keeper.accept(8, {3, {}}, {.owns_machine = false}));
    EXPECT_EQ(keeper.take_outdated(), std::vector<std::uint64_t>{7});
}

TEST(ValueKeeper, AJobWithoutAProgramChangesNothing) {
    ValueKeeper keeper(3, with_x(1));
    ASSERT_TRUE(keeper.accept(7, {3, with_x(2)}, {}));
    keeper.take(begun(0));
    keeper.take(ended(0, JobOutcome::Done));
    EXPECT_EQ(keeper.values(), with_x(1));
}

TEST(ValueKeeper, AStandbyFollowsTheOwnerAndEndsItsJob) {
    ValueKeeper keeper(0, {});
    const ValueKeeper::Circumstances standby{.owns_machine = false};
    ASSERT_TRUE(keeper.accept(8, edit(9), standby)) << "an edit, which the owner decides";
    ASSERT_TRUE(keeper.accept(7, {3, with_x(2)}, standby));
    keeper.follow(3, with_x(1));
    EXPECT_EQ(keeper.values(), with_x(1));
    keeper.take(ended(7, JobOutcome::Done));  // the keeper took the job over, so it has no event of its beginning
    EXPECT_EQ(keeper.values(), with_x(2));
    EXPECT_EQ(keeper.revision(), 4U);
}

TEST(ValueKeeper, ProgramsThatArriveDuringAJobDoNotReplaceItsValues) {
    ValueKeeper keeper(3, with_x(1));
    ASSERT_TRUE(keeper.accept(7, {3, with_x(2)}, {}));
    keeper.take(begun(7));
    for (std::uint64_t i = 10; i < 20; ++i) { ASSERT_TRUE(keeper.accept(i, {3, {}}, {})); }
    keeper.take(ended(7, JobOutcome::Done));
    EXPECT_EQ(keeper.values(), with_x(2));
}

TEST(ValueKeeper, WhatAProgramLeavesMayArriveWhileItRuns) {
    ValueKeeper keeper(3, with_x(1));
    ASSERT_TRUE(keeper.accept(7, {3, {}}, {}));
    ASSERT_TRUE(keeper.accept(8, {3, {}}, {}));
    keeper.take(begun(7));
    keeper.note_left(8, with_x(4));
    keeper.note_left(7, with_x(2));
    keeper.note_left(8, with_x(5));
    keeper.take(ended(7, JobOutcome::Done));
    EXPECT_EQ(keeper.values(), with_x(2)) << "and not what another program leaves";
}

}  // namespace
}  // namespace lockstep
