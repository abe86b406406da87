// The coordinator's side of an epoch: its frames, its vetoes and its end.
#include "core/coordinator/epoch/epoch_runner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>

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

/// The state that the axis reports in a slot.
std::vector<AxisView> says(Slot slot, FrameNumber held, std::optional<FrameNumber> veto, FrameNumber ran, Position at,
                           Epoch epoch = 1) {
    const bool rests = ran > 0;
    return {
        {AxisState{
             .stamp = slot, .epoch = epoch, .held = held, .veto = veto, .ran = ran, .at_rest = rests, .position = at},
         slot}};
}

/// A runner with an epoch that begins in slot 100 at position 0.
EpochRunner runner_of(const MachineConfig& machine, const Program& program) {
    const ProgramPlanner planner(machine);
    const std::size_t axes = machine.axes.size();
    AxisCounts start;
    for (std::size_t i = 0; i < axes; ++i) { start.append(0); }
    const auto legs = planner.plan(program, start).value();
    EpochRunner runner(machine);
    runner.load(planner.frames(std::make_shared<const Program>(program), legs[0]));
    MotorPositions at;
    for (std::size_t i = 0; i < axes; ++i) { at.append({}); }
    runner.begin(1, {legs[0].first, {}}, at, {}, {});
    (void)runner.send(100, {});
    return runner;
}

Program long_move() {
    return {.name = "long", .axes = {"X"}, .start_mm = {0}, .blocks = {{1, ProgramMove{{900}, 0, true}}}};
}

EpochRunner on_a_long_move() { return runner_of(one_slow_axis(), long_move()); }

/// If the link between two axes breaks, only the coordinator can repeat a veto to the other axis.
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

TEST(EpochRunner, RepeatsOnlyTheFramesBeforeAVeto) {
    const auto repeated = [](std::optional<FrameNumber> veto) {
        EpochRunner runner = on_a_long_move();
        Slot slot = 101;
        for (; runner.made().newest() < 2; ++slot) { (void)runner.send(slot, says(slot, 0, {}, 0, {})); }
        std::vector<FrameNumber> numbers;
        for (const Frame& frame : runner.send(slot, says(slot, 0, veto, 0, {}))) { numbers.push_back(frame.number); }
        return numbers;
    };
    EXPECT_EQ(repeated({}), (std::vector<FrameNumber>{2})) << "frame 1 would be late";
    EXPECT_EQ(repeated(3), (std::vector<FrameNumber>{2}));
    EXPECT_EQ(repeated(2), (std::vector<FrameNumber>{}));
}

/// Braking takes two seconds. The coordinator remembers the ends of far fewer frames than that.
TEST(EpochRunner, MakesNoFramesBehindAVetoHoweverLongTheTail) {
    EpochRunner runner = on_a_long_move();

    constexpr FrameNumber kRan = 600;  // at full speed
    Slot slot = 100;
    std::optional<Position> rest;
    for (; runner.made().newest() < kRan; ++slot) {
        for (const Frame& frame : runner.send(slot, says(slot, runner.made().newest(), {}, 0, {}))) {
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
    EXPECT_EQ(runner.made().newest(), kRan);
    const auto end = runner.evaluate(slot, says(slot, kRan, kRan + 1, kRan, *rest));
    ASSERT_TRUE(end.has_value());
    EXPECT_EQ(end->kind, EpochEnd::Kind::Interrupted);
    EXPECT_EQ(end->ran, kRan);
}

TEST(EpochRunner, AnAxisThatMovesLongAfterAllTailsIsOverdue) {
    EpochRunner runner = on_a_long_move();
    Slot slot = 100;
    for (; runner.made().newest() < 20; ++slot) {
        (void)runner.send(slot, says(slot, runner.made().newest(), {}, 0, {}));
    }
    runner.stop(slot);
    const Slot patience = 2 * 16 + 2;
    slot += 100'000;  // the coordinator's own stall proves nothing
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

/// The last frames of the previous epoch may still begin in the future.
TEST(EpochRunner, SendsNoFrameOfAnEpochBefore) {
    EpochRunner runner = on_a_long_move();
    Slot slot = 101;
    for (; runner.made().newest() < 3; ++slot) { (void)runner.send(slot, says(slot, 0, {}, 0, {})); }
    runner.stop(slot);
    runner.begin(2, {0, {}}, {Position{}}, {}, {});
    for (const Slot last = slot + 30; slot < last; ++slot) {
        for (const Frame& frame : runner.send(slot, says(slot, 0, {}, 0, {}, 2))) { EXPECT_EQ(frame.epoch, 2u); }
    }
    EXPECT_GT(runner.made().newest(), 0u);
}

/// `along` of a place is in mm along its block.
TEST(EpochRunner, KnowsWhereTheProgramIsAtTheEndOfEachFrame) {
    EpochRunner runner = on_a_long_move();
    for (Slot slot = 101; runner.made().newest() < 40; ++slot) {
        for (const Frame& frame : runner.send(slot, says(slot, runner.made().newest(), {}, 0, {}))) {
            EXPECT_NEAR(100 * runner.made().place_at(frame.start).along.as_steps(), frame.axes[0].from.as_steps(), 1e-6)
                << frame.number;
        }
    }
}

/// The runner remembers only the last frames.
TEST(EpochRunner, ReturnsItsOldestPlaceForEarlierTimes) {
    EpochRunner runner = on_a_long_move();
    Position early;
    for (Slot slot = 101; runner.made().newest() < 200; ++slot) {
        for (const Frame& frame : runner.send(slot, says(slot, runner.made().newest(), {}, 0, {}))) {
            if (frame.number == 130) { early = frame.axes[0].from; }
        }
    }
    const double along_steps = 100 * runner.made().place_at(*runner.made().start() + Ticks{1}).along.as_steps();
    EXPECT_GT(along_steps, early.as_steps());
    EXPECT_EQ(runner.made().place_at(*runner.made().start() + Ticks{1}),
              runner.made().place_at(*runner.made().start() + Ticks{5000}));
}

Program moves_of_0_05_mm(int count) {
    Program program{.name = "many", .axes = {"X"}, .start_mm = {0}};
    for (int line = 1; line <= count; ++line) {
        program.blocks.push_back({line, ProgramMove{{0.05 * line}, 5, false}});
    }
    return program;
}

TEST(EpochRunner, TurnsOnceBehindEachFrameToTheNewestOverrides) {
    EpochRunner runner = runner_of(one_slow_axis(), moves_of_0_05_mm(20'000));
    std::vector<FrameNumber> behind;
    runner.source()->read_ahead();
    for (Slot slot = 101; slot < 151; ++slot) {
        runner.overrides().set({50 + static_cast<int>(slot - 100), 100});  // another feed in each slot
        (void)runner.send(slot, says(slot, runner.made().newest(), {}, 0, {}));
        if (const auto change = runner.overrides().take_change()) {
            EXPECT_EQ(change->overrides.feed_percent, 50 + slot - 100);
            EXPECT_EQ(change->behind + 1, runner.made().newest());
            behind.push_back(change->behind);
        }
    }
    EXPECT_GE(behind.size(), 6u);
    EXPECT_EQ(std::ranges::adjacent_find(behind), behind.end());
}

/// A source of frames that become known when the test sets `is_known`.
class LateFrames final : public FrameSource {
public:
    LateFrames(std::unique_ptr<FrameSource> frames, const bool& is_known)
        : frames_(std::move(frames)), known_(&is_known) {}
    LateFrames(const LateFrames& other) : frames_(other.frames_), known_(other.known_) {}
    std::unique_ptr<FrameSource> clone() const override { return std::make_unique<LateFrames>(*this); }
    void resume(const PathPlace& place, std::span<const Position> at, const Overrides& overrides) override {
        frames_->resume(place, at, overrides);
    }
    bool read() override { return frames_->read(); }
    bool lacks_blocks() override { return !*known_; }
    bool is_ready() override { return *known_ && frames_->is_ready(); }
    bool is_done() const override { return frames_->is_done(); }
    std::expected<const PathFrame*, PathStuck> next() override {
        if (!*known_) { return nullptr; }
        return frames_->next();
    }
    const std::vector<MoveBegin>& begins() const override { return frames_->begins(); }
    bool set_overrides(const Overrides& overrides) override { return frames_->set_overrides(overrides); }
    LegEnd end() const override { return frames_->end(); }
    std::optional<std::int32_t> line_of(std::uint32_t block) const override { return frames_->line_of(block); }
    double seconds_from(const PathPlace& place) const override { return frames_->seconds_from(place); }

private:
    OwnedSource frames_;
    const bool* known_;
};

class LatePlanner : public testing::Test {
protected:
    LatePlanner() : runner(machine) {
        const ProgramPlanner planner(machine);
        const auto legs = planner.plan(program, {0}).value();
        auto frames = planner.frames(std::make_shared<const Program>(program), legs[0]);
        runner.load(OwnedSource(std::make_unique<LateFrames>(std::move(frames), is_known)));
        runner.begin(1, {0, {}}, {Position{}}, {}, {});
    }
    /// Sends frames slot by slot up to `until`. Sets `rest` to the place where the last frame rests.
    void go_on(Slot until) {
        for (; slot < until; ++slot) {
            for (const Frame& frame : runner.send(slot, says(slot, runner.made().newest(), {}, 0, {}))) {
                Position at = frame.axes[0].from;
                for (const Piece& piece : frame.axes[0].body) { at = at + piece.covered(); }
                for (const Piece& piece : frame.axes[0].tail) { at = at + piece.covered(); }
                if (frame.number == runner.made().newest()) { rest = at; }
            }
        }
    }

    MachineConfig machine = one_slow_axis();
    Program program = moves_of_0_05_mm(2'000);
    bool is_known = false;
    EpochRunner runner;
    Slot slot = 100;
    Position rest;
};

TEST_F(LatePlanner, StartsWhenItsFirstFrameIsKnown) {
    go_on(200);
    EXPECT_FALSE(runner.made().start());
    EXPECT_EQ(runner.made().newest(), 0u);
    EXPECT_FALSE(runner.evaluate(slot, says(slot, 0, {}, 0, {})));
    is_known = true;
    go_on(201);
    ASSERT_TRUE(runner.made().start());
    EXPECT_GT(rules::slot_of(*runner.made().start(), machine.slot_ticks()), 200 + machine.timing.send_ahead_slots);
    EXPECT_FALSE(runner.ending());
}

TEST_F(LatePlanner, IsInterruptedBeforeItsFirstFrameWhereItBegins) {
    go_on(150);
    runner.stop(slot);
    const auto end = runner.evaluate(slot, says(slot, 0, {}, 0, {}));
    ASSERT_TRUE(end);
    EXPECT_EQ(end->kind, EpochEnd::Kind::Interrupted);
    EXPECT_EQ(end->place, (PathPlace{0, {}}));
}

TEST_F(LatePlanner, RestsOnThePathAndGoesOnFromThere) {
    is_known = true;
    go_on(1000);
    const FrameNumber ran = runner.made().newest();
    is_known = false;
    go_on(1100);
    EXPECT_EQ(runner.made().newest(), ran) << "no frame is made up";
    EXPECT_EQ(runner.ending(), EpochRunner::Ending::LacksProgram);
    slot += 1000;
    const auto end = runner.evaluate(slot, says(slot, ran, ran + 1, ran, rest));
    ASSERT_TRUE(end);
    ASSERT_EQ(end->kind, EpochEnd::Kind::Interrupted);
    EXPECT_GT(end->place.block, 10u);
    EXPECT_NEAR(rest.as_steps(), 5.0 * end->place.block + 100 * end->place.along.as_steps(), 1e-6);

    is_known = true;
    runner.begin(2, end->place, end->positions, {}, {});
    bool is_done = false;
    for (const Slot last = slot + 40'000; slot < last && !is_done; ++slot) {
        for (const Frame& frame : runner.send(slot, says(slot, runner.made().newest(), {}, 0, {}, 2))) {
            is_done = frame.last;
            if (frame.number == 1) { EXPECT_EQ(frame.axes[0].from, rest); }
            rest = frame.axes[0].from;
            for (const Piece& piece : frame.axes[0].body) { rest = rest + piece.covered(); }
        }
    }
    EXPECT_TRUE(is_done);
    EXPECT_EQ(rest.count(), 10'000);
}

TEST_F(LatePlanner, ReportsMissingBlocksIfTheDueFrameLackedThemDespiteALaterStall) {
    is_known = true;
    go_on(1000);
    for (const FrameNumber sent = runner.made().newest(); runner.made().newest() == sent;) { go_on(slot + 1); }
    is_known = false;
    go_on(slot + machine.timing.frame_slots);  // the next one is due
    ASSERT_FALSE(runner.ending());
    is_known = true;  // but this process stalls
    slot += 50;
    go_on(slot + 1);
    EXPECT_EQ(runner.ending(), EpochRunner::Ending::LacksProgram);
}

TEST_F(LatePlanner, LacksBlocksWhereItFindsNoneAfterItsOwnStall) {
    is_known = true;
    go_on(1000);
    is_known = false;
    slot += 50;
    go_on(slot + 1);
    EXPECT_EQ(runner.ending(), EpochRunner::Ending::LacksProgram);
}

TEST_F(LatePlanner, LacksNoBlocksWhereOnlyThisProcessWasLate) {
    is_known = true;
    go_on(1000);
    slot += 50;
    go_on(slot + 1);
    EXPECT_EQ(runner.ending(), EpochRunner::Ending::Late);
}

/// Three axes after the first one moved and was stopped behind frame 3.
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
    EndOfEpoch() : runner(runner_of(machine(), long_move())) {
        axes.assign(3, says(100, 0, {}, 0, {})[0]);
        Position rest;
        for (; runner.made().newest() < kRan; ++slot) {
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
    for (std::size_t i = 1; i < axes.size(); ++i) {
        axes[i].state->ran = kRan - 1;
        const auto end = runner.evaluate(slot, axes);
        ASSERT_TRUE(end.has_value());
        EXPECT_EQ(end->kind, EpochEnd::Kind::FramesDiffer);
        EXPECT_EQ(end->motor, i);
        axes[i].state->ran = kRan;
    }
}

TEST_F(EndOfEpoch, NamesTheAxisThatIsMisplaced) {
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const Position rest = std::exchange(axes[i].state->position, Position::steps(1));
        const auto end = runner.evaluate(slot, axes);
        ASSERT_TRUE(end.has_value());
        EXPECT_EQ(end->kind, EpochEnd::Kind::Misplaced);
        EXPECT_EQ(end->motor, i);
        axes[i].state->position = rest;
    }
}

TEST_F(EndOfEpoch, WaitsForAnyAxisThatMoves) {
    for (AxisView& axis : axes) {
        axis.state->at_rest = false;
        EXPECT_FALSE(runner.evaluate(slot, axes).has_value());
        axis.state->at_rest = true;
    }
    EXPECT_TRUE(runner.evaluate(slot, axes).has_value());
}

TEST_F(EndOfEpoch, LeavesOutAnAxisThatIsNotPresent) {
    axes[1].state->at_rest = false;
    axes[1].received = slot - 1000;
    EXPECT_EQ(runner.evaluate(slot, axes)->kind, EpochEnd::Kind::Interrupted);
}

TEST_F(EndOfEpoch, ReportsFramesThatWereNeverSent) {
    for (AxisView& axis : axes) { axis.state->ran = kRan + 1; }
    EXPECT_EQ(runner.evaluate(slot, axes)->kind, EpochEnd::Kind::FramesDiffer);
}

}  // namespace
}  // namespace lockstep
