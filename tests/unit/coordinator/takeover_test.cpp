// A new owner continues the rest of the previous owner's job, or reports why the job does not continue. `along` of a
// place is in mm along its block.
#include "core/coordinator/jobs/takeover.hpp"

#include <gtest/gtest.h>

#include "core/coordinator/program/program_store.hpp"

namespace lockstep {
namespace {

/// Two axes on a program of two moves; both ran frame 5 of epoch 9, and rest within the first move.
class RestOfJob : public testing::Test {
protected:
    static constexpr FrameNumber kRan = 5;
    static constexpr Epoch kEpoch = 9;

    static MachineConfig make_machine() {
        MachineConfig machine{.name = "two"};
        machine.timing = {
            .slot_us = 1000, .stall_slots = 1, .freshness_slots = 2, .send_ahead_slots = 12, .frame_slots = 5};
        machine.axes.push_back({.name = "X",
                                .steps_per_mm = 100,
                                .start_velocity_mm_s = 10,
                                .max_velocity_mm_s = 50,
                                .max_accel_mm_s2 = 500,
                                .max_decel_mm_s2 = 500,
                                .position_max_mm = 100});
        machine.axes.push_back(machine.axes[0]);
        machine.axes[1].name = "Y";
        return machine;
    }

    RestOfJob() {
        program.blocks = {{1, ProgramMove{{30, 20}, 20, false}}, {2, ProgramMove{{60, 20}, 20, false}}};
        rest_at(10);
    }
    /// Both axes rest on the path, `along_mm` along the block.
    void rest_at(double along_mm, std::uint32_t block = 0) {
        const double x = block == 0 ? 10 + along_mm : 30 + along_mm;
        const std::vector<Position> positions{{static_cast<Int128>(x * 100 * 0x1p64)}, Position::steps(2000)};
        last.rests = {{kRan, {block, mm(along_mm)}, false, digest_of(positions)}};
        axes.clear();
        for (std::uint32_t i = 0; i < 2; ++i) {
            axes.push_back({.state = AxisState{.axis = i,
                                               .epoch = kEpoch,
                                               .ran = kRan,
                                               .homed = true,
                                               .phase = AxisPhase::Standby,
                                               .position = positions[i]}});
        }
    }
    static Displacement mm(double way) { return {static_cast<Int128>(way * 0x1p64)}; }
    AxisState& y() { return *axes[1].state; }
    std::expected<JobRest, TakeoverDoubt> rest() const {
        ProgramStore programs(machine);
        programs.accept(1, program);
        return rest_of_job(last, *programs.find(1), machine, axes);
    }
    TakeoverDoubt doubt() const {
        const auto found = rest();
        return found ? TakeoverDoubt::NotAsked : found.error();  // NotAsked stands for no doubt
    }

    MachineConfig machine = make_machine();
    Program program{.name = "two", .axes = {"X", "Y"}, .start_mm = {10, 20}, .blocks = {}};
    MachineState last{.epoch = kEpoch, .leg_from = {1000, 2000}};
    std::vector<AxisView> axes;
};

TEST_F(RestOfJob, GoesOnFromTheMiddleOfAMove) {
    const auto found = rest();
    ASSERT_TRUE(found.has_value());
    EXPECT_FALSE(found->done);
    EXPECT_EQ(found->place, (PathPlace{0, mm(10)}));
    EXPECT_EQ(found->positions.size(), 2u);
    EXPECT_EQ(found->positions[0].count(), 2000);
}

TEST_F(RestOfJob, GoesOnAtTheEndOfAMove) {
    rest_at(20);
    const auto found = rest();
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->place, (PathPlace{0, mm(20)}));
    EXPECT_EQ(found->positions[0].count(), 3000);
}

TEST_F(RestOfJob, IsDoneBehindTheLastFrameOfTheLastLeg) {
    rest_at(30, 1);
    last.rests[0].last = true;
    const auto found = rest();
    ASSERT_TRUE(found.has_value());
    EXPECT_TRUE(found->done);
    rest_at(20);
    last.rests[0].last = true;
    EXPECT_EQ(doubt(), TakeoverDoubt::OtherPlan) << "the last frame ends a leg, and another move follows";
}

TEST_F(RestOfJob, IsInDoubtWithAnAxisThatIsMissingUnhomedInFaultOrInMotion) {
    y().homed = false;
    EXPECT_EQ(doubt(), TakeoverDoubt::AxisInDoubt);
    y().homed = true;
    y().fault = FaultCode::LimitHit;
    EXPECT_EQ(doubt(), TakeoverDoubt::AxisInDoubt);
    y().fault = FaultCode::None;
    y().at_rest = false;
    EXPECT_EQ(doubt(), TakeoverDoubt::AxisInDoubt);
    y().at_rest = true;
    EXPECT_EQ(doubt(), TakeoverDoubt::NotAsked);
    axes[1].state.reset();
    EXPECT_EQ(doubt(), TakeoverDoubt::AxisInDoubt);
}

TEST_F(RestOfJob, IsInDoubtWhenTheAxesRanOtherFramesOrUnreceivedOnes) {
    y().ran = kRan - 1;
    EXPECT_EQ(doubt(), TakeoverDoubt::FramesDiffer);
    axes[0].state->ran = kRan - 1;
    EXPECT_EQ(doubt(), TakeoverDoubt::UnreceivedFrames) << "where that frame ends was not received";
    rest_at(10);
    y().epoch = kEpoch + 1;
    EXPECT_EQ(doubt(), TakeoverDoubt::UnreceivedFrames);
    y().epoch = kEpoch - 1;
    EXPECT_EQ(doubt(), TakeoverDoubt::FramesDiffer) << "of this epoch it ran none";
}

TEST_F(RestOfJob, IsInDoubtWhereThePlaceIsNotOnTheProgram) {
    last.rests[0].place.along = Displacement{-1};
    EXPECT_EQ(doubt(), TakeoverDoubt::OtherPlan);
    last.rests[0].place.along = mm(20.1);  // three steps are 0.03 mm
    EXPECT_EQ(doubt(), TakeoverDoubt::OtherPlan);
    last.rests[0].place = {77, {}};
    EXPECT_EQ(doubt(), TakeoverDoubt::OtherPlan);
}

TEST_F(RestOfJob, IsInDoubtWithAnAxisElsewhereThanItsFramesEnd) {
    const Position right = y().position;
    y().position = right + Displacement::steps(1);
    EXPECT_EQ(doubt(), TakeoverDoubt::Misplaced);
    y().position = right - Displacement::steps(1);
    EXPECT_EQ(doubt(), TakeoverDoubt::Misplaced);
    y().position = right + Displacement{1};
    EXPECT_EQ(doubt(), TakeoverDoubt::Misplaced) << "near, but not the place that the owner reported";
}

TEST_F(RestOfJob, TakesThePositionOfAnAxisThatTheProgramDoesNotName) {
    program.axes = {"X"};
    program.start_mm = {10};
    program.blocks = {{1, ProgramMove{{30}, 20, false}}};
    rest_at(10);
    EXPECT_TRUE(rest().has_value());
    EXPECT_EQ(rest()->from[1], 2000);
}

TEST_F(RestOfJob, BeforeItsFirstFrameStartsOnWholeSteps) {
    rest_at(0);
    last.rests[0].frame = 0;
    for (AxisView& axis : axes) { axis.state->ran = 0; }
    last.rests[0].digest += 1;  // the owner made the digest of the exact positions at its start
    const auto found = rest();
    ASSERT_TRUE(found.has_value());
    EXPECT_TRUE(found->positions.empty());
    EXPECT_EQ(found->place, (PathPlace{0, {}}));
}

/// The digest is ignored only before the first frame. Once a frame was run, the axes must rest where it ends.
TEST_F(RestOfJob, IsInDoubtIfAnAxisIsNotWhereTheFirstFrameEnds) {
    rest_at(0);
    last.rests[0].frame = 1;
    for (AxisView& axis : axes) { axis.state->ran = 1; }
    EXPECT_EQ(doubt(), TakeoverDoubt::NotAsked);
    last.rests[0].digest += 1;
    EXPECT_EQ(doubt(), TakeoverDoubt::Misplaced);
}

/// The motors rest a step beside the path, because their steps are coarser than the axes'.
TEST_F(RestOfJob, TakesThePlaceWhereTheLegBeganOfAnAxisThatTheProgramDoesNotName) {
    program.axes = {"X"};
    program.start_mm = {10};
    program.blocks = {{1, ProgramMove{{30}, 20, false}}};
    rest_at(10);
    last.leg_from = {1000, 2002};
    ASSERT_TRUE(rest().has_value());
    EXPECT_EQ(rest()->from[1], 2002);
    last.leg_from = {1000, 2010};
    EXPECT_EQ(doubt(), TakeoverDoubt::Misplaced) << "it is not there";
    last.leg_from = {};
    EXPECT_EQ(doubt(), TakeoverDoubt::OtherPlan) << "the owner did not say it";
}

/// Joining of moves and rounding to whole steps take an axis up to three steps from the program.
TEST_F(RestOfJob, GoesOnThreeStepsFromThePlaceOfTheProgramAndNoFarther) {
    for (AxisConfig& axis : machine.axes) { axis.steps_per_mm = 64; }  // steps are exact in mm
    program.blocks.insert(program.blocks.begin(), {.action = Dwell{1}});
    for (const int off : {3, 4}) {
        const std::vector<Position> positions{Position::steps(640 + off), Position::steps(1280)};
        for (std::size_t i = 0; i < 2; ++i) { axes[i].state->position = positions[i]; }
        last.rests = {{kRan, {0, {}}, false, digest_of(positions)}};
        EXPECT_EQ(doubt(), off == 3 ? TakeoverDoubt::NotAsked : TakeoverDoubt::Misplaced) << off;
    }
}

TEST(TakeoverDoubtText, NamesEachDoubt) {
    EXPECT_NE(text_of(TakeoverDoubt::NotAsked).find("--on-takeover"), std::string_view::npos);
    EXPECT_NE(text_of(TakeoverDoubt::FramesDiffer).find("same frames"), std::string_view::npos);
    EXPECT_NE(text_of(TakeoverDoubt::Misplaced).find("not where its frames end"), std::string_view::npos);
}

}  // namespace
}  // namespace lockstep
