// How an epoch comes to its end, as the coordinator sees it.
#include "core/coordinator/path/epoch_runner.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/coordinator/path/program_plan.hpp"

namespace lockstep {
namespace {

MachineConfig one_slow_axis() {
    MachineConfig machine{.name = "slow"};
    machine.timing = {.slot_us = 1000,
                      .stall_slots = 1,
                      .late_check_slots = 0,
                      .freshness_slots = 2,
                      .send_ahead_slots = 12,
                      .frame_slots = 5};
    machine.axes.push_back({.name = "X",
                            .steps_per_mm = 100,
                            .start_velocity_mm_s = 1,
                            .max_velocity_mm_s = 50,
                            .max_accel_mm_s2 = 25,
                            .max_decel_mm_s2 = 25,
                            .position_max_mm = 1000});
    return machine;
}

/// The axis as it says it is in a slot.
std::vector<AxisView> says(Slot slot, FrameNumber held, std::optional<FrameNumber> veto, FrameNumber ran, Position at) {
    const bool rests = ran > 0;
    return {
        {AxisState{.stamp = slot, .epoch = 1, .held = held, .veto = veto, .ran = ran, .at_rest = rests, .position = at},
         slot}};
}

/// 900 mm, begun in slot 100.
EpochRunner on_a_long_move() {
    const MachineConfig machine = one_slow_axis();
    const ProgramPlanner planner(machine);
    const Program program{.name = "long", .axes = {"X"}, .start_mm = {0}, .blocks = {{1, LinearMove{{900}, 0, true}}}};
    const auto legs = planner.plan(program, {0}).value();
    EpochRunner runner(machine);
    runner.begin(1, planner.path(legs[0].moves, {}), {Position::steps(0)}, 100);
    return runner;
}

/// With two axes nobody else is there to repeat it when the link between them breaks.
TEST(EpochRunner, RepeatsTheLowestVetoItReceives) {
    EpochRunner runner = on_a_long_move();
    (void)runner.send(110, says(110, 0, {}, 0, {}));
    EXPECT_EQ(runner.veto(), std::nullopt);
    (void)runner.send(111, says(111, 1, 3, 0, {}));
    (void)runner.send(112, says(112, 1, 2, 0, {}));
    (void)runner.send(113, says(113, 1, 3, 0, {}));
    EXPECT_EQ(runner.veto(), 2u);
    runner.stop(100);
    EXPECT_EQ(runner.veto(), 1u);
}

/// Two seconds of braking are far more frames than the coordinator remembers the ends of.
TEST(EpochRunner, MakesNoFramesBehindAVetoHoweverLongTheTail) {
    EpochRunner runner = on_a_long_move();

    constexpr FrameNumber kRan = 600;  // at full speed
    Slot slot = 100;
    std::optional<Position> rest;
    for (; runner.sent() < kRan; ++slot) {
        for (const Frame& frame : runner.send(slot, says(slot, runner.sent(), {}, 0, {}))) {
            if (frame.number != kRan) { continue; }
            rest = frame.axes[0].from;
            for (const Piece& piece : frame.axes[0].body) { rest = *rest + piece.covered(); }
            for (const Piece& piece : frame.axes[0].tail) { rest = *rest + piece.covered(); }
        }
    }
    ASSERT_TRUE(rest.has_value());
    for (const Slot braked = slot + 2000; slot < braked; ++slot) {
        (void)runner.send(slot, says(slot, kRan, kRan + 1, 0, {}));
    }
    EXPECT_EQ(runner.sent(), kRan);
    const auto end = runner.evaluate(slot, says(slot, kRan, kRan + 1, kRan, *rest));
    ASSERT_TRUE(end.has_value());
    EXPECT_EQ(end->kind, EpochEnd::Kind::Interrupted);
    EXPECT_EQ(end->ran, kRan);
}

TEST(EpochRunner, AnAxisThatMovesLongAfterAllTailsIsOverdue) {
    EpochRunner runner = on_a_long_move();
    Slot slot = 100;
    for (; runner.sent() < 20; ++slot) { (void)runner.send(slot, says(slot, runner.sent(), {}, 0, {})); }
    runner.stop(slot);
    const Slot patience = 2 * 16 + 2;
    slot += 100'000;  // a stall of its own proves nothing
    for (Slot asked = 0; asked < patience; ++asked) {
        ++slot;
        (void)runner.send(slot, says(slot, 20, 21, 0, {}));
        EXPECT_FALSE(runner.is_overdue()) << asked;
    }
    ++slot;
    (void)runner.send(slot, says(slot, 20, 21, 0, {}));
    EXPECT_TRUE(runner.is_overdue());
    EXPECT_FALSE(runner.evaluate(slot, says(slot, 20, 21, 0, {})).has_value());
}

/// 20,000 moves of 0.05 mm, begun in slot 100.
EpochRunner on_a_path_of_20000_moves() {
    const MachineConfig machine = one_slow_axis();
    const ProgramPlanner planner(machine);
    Program program{.name = "many", .axes = {"X"}, .start_mm = {0}};
    for (int line = 1; line <= 20'000; ++line) {
        program.blocks.push_back({line, LinearMove{{0.05 * line}, 5, false}});
    }
    const auto legs = planner.plan(program, {0}).value();
    EpochRunner runner(machine);
    runner.begin(1, planner.path(legs[0].moves, {}), {Position::steps(0)}, 100);
    return runner;
}

/// Planning so many moves again takes tens of milliseconds: the next frame must not wait for it.
TEST(EpochRunner, PlansALongRestAnewOnceAFrameAndNeverWhenAFrameIsDue) {
    EpochRunner runner = on_a_path_of_20000_moves();
    const Slot half_a_frame = one_slow_axis().timing.frame_slots / 2;
    Slot planned = 0;
    std::vector<FrameNumber> behind;
    for (Slot slot = 100; slot < 150; ++slot) {
        runner.turn({50 + static_cast<int>(slot - 100), 100});  // each slot another
        const bool sends = !runner.send(slot, says(slot, runner.sent(), {}, 0, {})).empty();
        if (sends) { EXPECT_GT(slot - planned, half_a_frame) << "slot " << slot; }
        if (const auto turn = runner.take_turn()) {
            EXPECT_FALSE(sends) << "slot " << slot;
            EXPECT_EQ(turn->overrides.feed_percent, 50 + slot - 100) << "the newest counts";
            behind.push_back(turn->behind);
            planned = slot;
        }
    }
    EXPECT_GE(behind.size(), 6u);
    EXPECT_EQ(std::ranges::adjacent_find(behind), behind.end()) << "once behind each frame";
}

/// Three axes after frame 3 of a move of the first, which was stopped behind it.
class EndOfEpoch : public testing::Test {
protected:
    static constexpr FrameNumber kRan = 3;

    static MachineConfig machine() {
        MachineConfig machine = one_slow_axis();
        machine.axes.push_back(machine.axes[0]);
        machine.axes.push_back(machine.axes[0]);
        machine.axes[1].name = "Y";
        machine.axes[2].name = "Z";
        return machine;
    }
    EndOfEpoch() : runner(machine()) {
        const ProgramPlanner planner(machine());
        const Program program{
            .name = "long", .axes = {"X"}, .start_mm = {0}, .blocks = {{1, LinearMove{{900}, 0, true}}}};
        const auto legs = planner.plan(program, {0, 0, 0}).value();
        runner.begin(1, planner.path(legs[0].moves, {}), std::vector<Position>(3), 100);
        axes.assign(3, says(100, 0, {}, 0, {})[0]);
        Position rest;
        for (; runner.sent() < kRan; ++slot) {
            for (const Frame& frame : runner.send(slot, axes)) {
                rest = frame.axes[0].from;
                for (const Piece& piece : frame.axes[0].body) { rest = rest + piece.covered(); }
                for (const Piece& piece : frame.axes[0].tail) { rest = rest + piece.covered(); }
            }
        }
        runner.stop(slot);
        slot += 1000;
        for (AxisView& axis : axes) { axis = says(slot, kRan, kRan + 1, kRan, {})[0]; }
        axes[0].state->position = rest;
    }

    EpochRunner runner;
    std::vector<AxisView> axes;
    Slot slot = 100;
};

TEST_F(EndOfEpoch, IsInterruptedWhereAllRestWhereTheirFramesEnd) {
    const auto end = runner.evaluate(slot, axes);
    ASSERT_TRUE(end.has_value());
    EXPECT_EQ(end->kind, EpochEnd::Kind::Interrupted);
    EXPECT_EQ(end->ran, kRan);
    EXPECT_EQ(end->positions[0], axes[0].state->position);
}

TEST_F(EndOfEpoch, NamesTheAxisThatRanOtherFrames) {
    axes[2].state->ran = kRan - 1;
    const auto end = runner.evaluate(slot, axes);
    ASSERT_TRUE(end.has_value());
    EXPECT_EQ(end->kind, EpochEnd::Kind::FramesDiffer);
    EXPECT_EQ(end->axis, 2u);
}

TEST_F(EndOfEpoch, NamesTheAxisThatIsMisplaced) {
    axes[1].state->position = Position::steps(1);
    const auto end = runner.evaluate(slot, axes);
    ASSERT_TRUE(end.has_value());
    EXPECT_EQ(end->kind, EpochEnd::Kind::Misplaced);
    EXPECT_EQ(end->axis, 1u);
}

TEST_F(EndOfEpoch, WaitsForAnAxisThatMoves) {
    axes[1].state->at_rest = false;
    EXPECT_FALSE(runner.evaluate(slot, axes).has_value());
}

TEST_F(EndOfEpoch, LeavesOutAnAxisThatIsNotPresent) {
    axes[1].state->at_rest = false;
    axes[1].received = slot - 1000;
    EXPECT_EQ(runner.evaluate(slot, axes)->kind, EpochEnd::Kind::Interrupted);
}

TEST_F(EndOfEpoch, OfFramesThatWereNotSentIsADifference) {
    for (AxisView& axis : axes) { axis.state->ran = kRan + 1; }
    EXPECT_EQ(runner.evaluate(slot, axes)->kind, EpochEnd::Kind::FramesDiffer);
}

}  // namespace
}  // namespace lockstep
