// The program of a leg is read a bounded amount at a time. The frames depend only on the program.
#include "core/coordinator/path/program_frames.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/coordinator/path/lai_frames.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "tests/unit/coordinator/long_axes.hpp"

namespace lockstep {
namespace {

Program line_in_parts(double length_mm, double part_mm, double feed_mm_s = 100) {
    Program program{.name = "line", .axes = {"X", "Y"}, .start_mm = {0, 0}};
    const auto parts = static_cast<int>(std::lround(length_mm / part_mm));
    for (int k = 1; k <= parts; ++k) { program.blocks.push_back({k, ProgramMove{{part_mm * k, 0}, feed_mm_s, false}}); }
    return program;
}

Program wave(int chords) {
    Program program{.name = "wave", .axes = {"X", "Y"}, .start_mm = {0, 0}};
    for (int k = 1; k <= chords; ++k) {
        program.blocks.push_back({k, ProgramMove{{0.1 * k, 10 - 10 * std::cos(0.01 * k)}, 60, false}});
    }
    return program;
}

class Frames : public testing::Test {
protected:
    explicit Frames(const Program& program = wave(2000), MachineConfig config = two_long_axes())
        : machine(std::move(config)), program_(std::make_shared<const Program>(program)) {
        leg = ProgramPlanner(machine).plan(*program_, {0, 0}).value()[0];
    }
    OwnedSource source() const {
        OwnedSource source = ProgramPlanner(machine).frames(program_, leg);
        source->resume({0, {}}, std::vector<Position>(2), {});
        return source;
    }
    static std::vector<PathFrame> up_to(OwnedSource& source, std::size_t count) {
        std::vector<PathFrame> frames;
        for (source->read_ahead(); frames.size() < count && !source->is_done(); source->read_ahead()) {
            frames.push_back(*source->next().value());
        }
        return frames;
    }
    static std::vector<Position> rest_of(const PathFrame& frame) {
        std::vector<Position> at;
        for (const AxisTrack& track : frame.axes) {
            at.push_back(track.from);
            for (const Piece& piece : track.body) { at.back() = at.back() + piece.covered(); }
            for (const Piece& piece : track.tail) { at.back() = at.back() + piece.covered(); }
        }
        return at;
    }
    static bool are_same(const PathFrame& a, const PathFrame& b) {
        return a.ticks == b.ticks && a.rest == b.rest && a.places == b.places && a.axes == b.axes;
    }

    MachineConfig machine;
    std::shared_ptr<const Program> program_;
    Leg leg;
};

class ProgramFramesTest : public Frames {};

TEST_F(ProgramFramesTest, ReadABoundedNumberOfBlocksAtATime) {
    OwnedSource source = this->source();
    int reads = 0;
    for (; !source->is_ready(); ++reads) { source->read(); }
    EXPECT_GE(reads, 2) << "2000 blocks are not read at once";
    EXPECT_FALSE(source->is_done());
}

TEST_F(ProgramFramesTest, DoNotDependOnHowFarTheProgramWasRead) {
    OwnedSource late = source();
    OwnedSource early = source();
    for (int n = 0; n < 1000; ++n) { early->read(); }
    const auto a = up_to(late, 1000);
    const auto b = up_to(early, 1000);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) { EXPECT_TRUE(are_same(a[k], b[k])) << k; }
    EXPECT_EQ(rest_of(a.back())[0].count(), leg.to[0]);
    EXPECT_EQ(rest_of(a.back())[1].count(), leg.to[1]);
}

TEST_F(ProgramFramesTest, GoOnFromARestAsANewSourceDoes) {
    OwnedSource source = this->source();
    const auto frames = up_to(source, 5);
    const std::vector<Position> rest = rest_of(frames[4]);
    source->resume(frames[4].rest, rest, {80, 100});
    OwnedSource other = ProgramPlanner(machine).frames(program_, leg);
    other->resume(frames[4].rest, rest, {80, 100});
    const auto a = up_to(source, 1000);
    const auto b = up_to(other, 1000);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) { EXPECT_TRUE(are_same(a[k], b[k])) << k; }
    EXPECT_EQ(a[0].axes[0].from, rest[0]);
}

TEST_F(ProgramFramesTest, NameTheMovesThatBeginInThem) {
    OwnedSource source = this->source();
    std::uint32_t next = 0;
    for (source->read_ahead(); !source->is_done(); source->read_ahead()) {
        const auto frame = source->next().value();
        for (const MoveBegin& begin : source->begins()) {
            if (begin.block + 1 == next) { continue; }  // also named at the end of the previous frame
            EXPECT_EQ(begin.block, next++);
            EXPECT_LE(begin.at, static_cast<double>(frame->ticks.value));
        }
    }
    EXPECT_EQ(next, 2000U);
}

Ticks duration_of(const Program& program) {
    const MachineConfig machine = two_long_axes();
    const ProgramPlanner planner(machine);
    const Leg leg = planner.plan(program, {0, 0}).value()[0];
    const auto source = planner.frames(std::make_shared<const Program>(program), leg);
    source->resume({0, {}}, std::vector<Position>(2), {});
    Ticks duration;
    for (source->read_ahead(); !source->is_done(); source->read_ahead()) { duration += (*source->next())->ticks; }
    return duration;
}

TEST(ProgramTime, OfALineIsTheSameHoweverFinelyItIsCut) {
    const auto whole = static_cast<double>(duration_of(line_in_parts(200, 200)).value);
    const double ramps = 92 * 92 / 1500.0 / 100;  // from 8 mm/s to 100 mm/s and back: 0.8 of the start velocity
    EXPECT_NEAR(whole, (2 + ramps) * 1e6, 1e3);
    for (const double part_mm : {50.0, 1.0, 0.05, 0.01}) {
        EXPECT_NEAR(static_cast<double>(duration_of(line_in_parts(200, part_mm)).value), whole, 1e-3 * whole)
            << part_mm;
    }
}

class ManyTurnsTest : public Frames {
protected:
    ManyTurnsTest() : Frames(turns(2000)) {}
    static Program turns(std::int32_t count) {
        Program program{.name = "turns", .axes = {"X", "Y"}, .start_mm = {0, 0}};
        ProgramMove arc{{20, 20}, 60, false};
        arc.arc = ArcShape{.centre_first_mm = 30, .centre_second_mm = 20, .turns = count};
        program.blocks = {{1, ProgramMove{{20, 20}, 60, false}}, {2, arc}, {3, ProgramMove{{0, 0}, 60, false}}};
        return program;
    }
};

/// A part of the arc is read in each slot, so that the frames begin before all of it is in memory.
TEST_F(ManyTurnsTest, AreReadABoundedAmountAtATime) {
    ProgramFrames frames(machine, std::make_shared<WholeProgram>(program_), 0, leg.from);
    frames.resume({0, {}}, std::vector<Position>(2), {});
    std::size_t made = 0;
    for (int slot = 0; slot < 300; ++slot) {
        (void)frames.read();
        while (frames.is_ready() && made < static_cast<std::size_t>(slot)) {
            ASSERT_TRUE(frames.next().has_value());
            ++made;
            EXPECT_LT(frames.kept(), 40'000U);
        }
        EXPECT_LT(frames.kept(), 40'000U);
    }
    EXPECT_GT(made, 250U);
}

/// A slot reads a part of the program. So the machine begins to move after as many slots, whatever the turns.
TEST_F(ManyTurnsTest, BeginAsSoonAsFewTurns) {
    const auto begin_of = [this](std::int32_t count) {
        ProgramFrames frames(machine, std::make_shared<WholeProgram>(std::make_shared<const Program>(turns(count))), 0,
                             leg.from);
        frames.resume({0, {}}, std::vector<Position>(2), {});
        int slots = 0;
        for (; !frames.is_ready(); ++slots) { EXPECT_TRUE(frames.read()); }
        return std::pair(slots, frames.kept());
    };
    const auto few = begin_of(300);
    EXPECT_LE(few.first, 10);
    EXPECT_EQ(begin_of(30'000), few);
    EXPECT_EQ(begin_of(kMaxTurns), few);
}

TEST_F(ManyTurnsTest, AreContinuedInTheMiddle) {
    OwnedSource source = this->source();
    const auto frames = up_to(source, 600);
    ASSERT_EQ(frames.size(), 600U);
    ASSERT_EQ(frames.back().rest.block, 1U);
    const std::vector<Position> rest = rest_of(frames.back());
    source->resume(frames.back().rest, rest, {});
    OwnedSource other = ProgramPlanner(machine).frames(program_, leg);
    other->resume(frames.back().rest, rest, {});
    OwnedSource third = other;  // begins to read where the other one begins
    const auto a = up_to(source, 200);
    const auto b = up_to(other, 200);
    const auto c = up_to(third, 200);
    ASSERT_EQ(a.size(), 200U);
    for (std::size_t k = 0; k < a.size(); ++k) {
        EXPECT_TRUE(are_same(a[k], b[k])) << k;
        EXPECT_TRUE(are_same(a[k], c[k])) << k;
    }
}

class ArcAtTheTravelTest : public Frames {
protected:
    ArcAtTheTravelTest() : Frames(arc(), machine_of_few_steps()) {}
    static MachineConfig machine_of_few_steps() {
        MachineConfig machine = two_long_axes();
        machine.axes[1].steps_per_mm = 4;
        machine.axes[1].position_min_mm = -500;
        machine.axes[1].position_max_mm = 0;
        return machine;
    }
    /// The arc's ends are 0.4 steps beyond the travel of Y, which is a quarter of the arc's radius.
    static Program arc() {
        Program program{.name = "arc", .axes = {"X", "Y"}, .start_mm = {0, 0}};
        ProgramMove arc{{0.875, 0.1}, 10, false};
        arc.arc = ArcShape{.centre_first_mm = 1, .centre_second_mm = 0.1 - 0.38, .is_clockwise = true};
        program.blocks = {{1, ProgramMove{{1.125, 0.1}, 10, false}}, {2, arc}, {3, ProgramMove{{0.5, 0.1}, 10, false}}};
        return program;
    }
};

TEST_F(ArcAtTheTravelTest, KeepsItsRadiusAndEndsWithinTheTravel) {
    OwnedSource source = this->source();
    double farthest = 0;
    Position x;
    Position y;
    Position y_before;
    for (const PathFrame& frame : up_to(source, 1000)) {
        for (std::size_t k = 0; k < frame.axes[0].body.size(); ++k) {
            const Piece& piece = frame.axes[0].body[k];
            for (Ticks t; t < piece.ticks; t += Ticks{10}) {
                farthest = std::max(farthest, (x + piece.covered(t)).as_steps());
            }
            x = x + piece.covered();
            y_before = y;
            y = y + frame.axes[1].body[k].covered();
        }
    }
    EXPECT_NEAR(farthest, (1 + 0.4) * machine.axes[0].steps_per_mm, 0.2);
    EXPECT_EQ(x.count(), 40);
    EXPECT_NEAR(y_before.as_steps(), 0, 1e-6) << "the line behind the arc is at the end of the travel";
}

class LaiFramesTest : public Frames {
protected:
    LaiFramesTest() : Frames(corner(), lai()) {}
    static MachineConfig lai() {
        MachineConfig machine = two_long_axes();
        machine.coordination = StepMethod::Lai;
        return machine;
    }
    static Program corner() {
        Program program{.name = "corner", .axes = {"X", "Y"}, .start_mm = {0, 0}};
        program.blocks = {
            {1, ProgramMove{{40, 10}, 50, false}}, {2, Dwell{0.1}}, {3, ProgramMove{{40, 60}, 50, false}}};
        return program;
    }
};

TEST_F(LaiFramesTest, EndWhereTheProgramDoes) {
    OwnedSource source = this->source();
    const auto frames = up_to(source, 1000);
    EXPECT_TRUE(frames.back().last);
    EXPECT_EQ(rest_of(frames.back())[0].count(), 3200);
    EXPECT_EQ(rest_of(frames.back())[1].count(), 4800);
}

/// The long axis leads. Its steps measure the way along the block.
TEST_F(LaiFramesTest, RestWhereTheyReport) {
    OwnedSource source = this->source();
    for (const PathFrame& frame : up_to(source, 1000)) {
        const Position lead = rest_of(frame)[frame.rest.block == 0 ? 0 : 1];
        const double before = frame.rest.block == 0 ? 0 : 800;  // of the first move
        if (frame.rest.block == 1) { continue; }                // the dwell
        EXPECT_NEAR(frame.rest.along.as_steps(), lead.as_steps() - before, 1e-6) << frame.rest.block;
    }
}

/// This also holds behind a rest within a period.
TEST_F(LaiFramesTest, AreTheSameWhenResumedTwiceAtOnePlace) {
    OwnedSource source = this->source();
    for (int rests = 0; rests < 3; ++rests) {
        const auto frames = up_to(source, 2);
        const std::vector<Position> rest = rest_of(frames[1]);
        source->resume(frames[1].rest, rest, {});
        OwnedSource again = source;
        again->resume(frames[1].rest, rest, {});
        OwnedSource once = source;
        const auto a = up_to(once, 1000);
        const auto b = up_to(again, 1000);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t k = 0; k < a.size(); ++k) { EXPECT_TRUE(are_same(a[k], b[k])) << rests << ": " << k; }
        EXPECT_GT(rest_of(a.front())[0].as_steps(), rest[0].as_steps()) << "on from where it rested";
        EXPECT_EQ(rest_of(a.back())[0].count(), 3200);
        EXPECT_EQ(rest_of(a.back())[1].count(), 4800);
    }
}

/// The belts rest on whole steps, so an axis may rest a little beyond its travel. The next leg begins where the belts
/// are.
TEST(FramesOfBelts, LeadAnAxisBackThatRestedBeyondItsTravelAndSaySo) {
    constexpr std::int64_t kEnd = 500 * 1280;
    const MachineConfig machine = two_long_belts();
    const auto program = std::make_shared<const Program>(
        Program{.name = "x", .axes = {"X"}, .start_mm = {0}, .blocks = {{1, ProgramMove{{10}, 50, false}}}});
    const ProgramPlanner planner(machine);
    const Kinematics kinematics(machine);
    const Leg leg = planner.plan(*program, {0, kEnd + 8}).value()[0];
    OwnedSource source = planner.frames(program, leg);
    const MotorPositions at = positions_of(kinematics.motors_at(leg.from).steps);
    source->resume({0, {}}, {at.begin(), at.size()}, {});
    MotorCounts end;
    for (source->read_ahead(); !source->is_done(); source->read_ahead()) {
        end.steps.clear();
        for (const AxisTrack& track : (*source->next().value()).axes) {
            Position rest = track.from;
            for (const Piece& piece : track.body) { rest = rest + piece.covered(); }
            end.steps.append(rest.count());
        }
    }
    EXPECT_EQ(source->end().to, (AxisCounts{12'800, kEnd}));
    EXPECT_EQ(leg.to, source->end().to);
    EXPECT_EQ(kinematics.motors_at(source->end().to), end);
}

class LaiFramesBehindADwell : public Frames {
protected:
    LaiFramesBehindADwell() : Frames(program(), lai()) {}
    static MachineConfig lai() {
        MachineConfig machine = two_long_axes();
        machine.coordination = StepMethod::Lai;
        return machine;
    }
    /// The dwell lasts as long as a frame.
    static Program program() {
        return {.name = "dwell",
                .axes = {"X", "Y"},
                .start_mm = {0, 0},
                .blocks = {{1, Dwell{0.05}}, {2, ProgramEvent{}}, {3, ProgramMove{{40, 10}, 50, false}}}};
    }
};

TEST_F(LaiFramesBehindADwell, NameTheMoveThatBeginsWhereAFrameEnds) {
    OwnedSource source = this->source();
    const auto frame = source->next().value();
    ASSERT_EQ(frame->ticks, Ticks{50'000});
    ASSERT_EQ(source->begins().size(), 2u);
    EXPECT_EQ(source->begins()[1].block, 2u);
    EXPECT_EQ(source->begins()[1].at, 50'000);
    ASSERT_EQ(source->events().size(), 1u) << "the event between them is due there";
    EXPECT_EQ(source->events()[0].at, Ticks{50'000});
}

TEST(ProgramPlan, ABlockThatTakesNoTimeIsNoMove) {
    const ProgramPlanner planner(two_long_axes());
    const Program program{.name = "still",
                          .axes = {"X", "Y"},
                          .start_mm = {0, 0},
                          .blocks = {{1, Dwell{0}}, {2, ProgramMove{{0, 0}, 10, false}}}};
    const auto legs = planner.plan(program, {0, 0});
    ASSERT_TRUE(legs);
    EXPECT_FALSE(legs->front().moves);
    EXPECT_TRUE(planner.moves_of(program, legs->front()).empty());
}

TEST(ProgramPlan, StartMismatchNamesNoLine) {
    const ProgramPlanner planner(two_long_axes());
    const auto legs = planner.plan(line_in_parts(10, 10), {80, 0});
    ASSERT_FALSE(legs);
    EXPECT_EQ(legs.error().fault, FaultCode::StartMismatch);
    EXPECT_FALSE(legs.error().line);
    EXPECT_EQ(legs.error().text, "the program starts at X 0 mm, but the axis is at 1 mm");
}

}  // namespace
}  // namespace lockstep
