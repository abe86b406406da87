// A report gives the unit of each move, counts dwells, and marks steps that are not known because the log lacks them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/analysis/analysis.hpp"
#include "clients/analysis/curves.hpp"
#include "clients/analysis/moves/deviation.hpp"
#include "clients/analysis/report.hpp"
#include "tests/unit/analysis/log_makers.hpp"

namespace lockstep::analysis {
namespace {

using test::even_steps;
using test::LogMaker;
using test::path_through;
using testing::IsEmpty;

/// A machine with a slide X and a rotary axis A.
MachineSetup slide_and_table() {
    MachineSetup machine;
    for (const char* name : {"X", "A"}) { machine.axes.push_back({.name = name, .steps_per_mm = 100}); }
    return machine;
}

MoveLog move(std::int64_t x_steps, std::int64_t a_steps, double deviation) {
    MoveLog made{.length_mm = 1, .largest_distance_mm = deviation};
    made.motors = {{x_steps, x_steps}, {a_steps, a_steps}};
    return made;
}

TEST(ReportUnits, DeviationOfRotaryAxesIsInDegreesAndOfBothKindsInBoth) {
    const std::vector<MoveLog> moves{move(5, 0, 0.01), move(0, 5, 0.02), move(5, 0, 0.005), move(5, 5, 0.03)};
    const MachineSetup machine = slide_and_table();
    EXPECT_EQ(name_of(motion_unit(machine, Kinematics(machine), moves[0])), "mm");
    EXPECT_EQ(name_of(motion_unit(machine, Kinematics(machine), moves[1])), "deg");
    EXPECT_EQ(name_of(motion_unit(machine, Kinematics(machine), moves[3])), "mm and deg");
    Deviations found = deviations(machine, Kinematics(machine), moves, 4, 0.03);
    EXPECT_EQ(to_text(found), "0.0100 mm, 0.0200 deg, 0.0300 mm and 0.0300 deg");
    add(found, {{MotionUnit::Deg, 0.04}, {MotionUnit::Mm, 0.001}});
    EXPECT_EQ(to_text(found), "0.0100 mm, 0.0400 deg, 0.0300 mm and 0.0300 deg");
}

TEST(ReportUnits, DeviationOfMovesThatAreNotKeptIsInAUnitTrueForAllAxes) {
    const std::vector<MoveLog> moves{move(5, 0, 0.01)};
    MachineSetup machine = slide_and_table();
    EXPECT_EQ(to_text(deviations(machine, Kinematics(machine), moves, 2, 0.05)), "0.0500 mm and 0.0500 deg");
    machine.axes.pop_back();
    EXPECT_EQ(to_text(deviations(machine, Kinematics(machine), moves, 2, 0.05)), "0.0500 mm");
    EXPECT_THAT(deviations(machine, Kinematics(machine), moves, 2, std::nullopt), IsEmpty());
}

struct ReportOfLog : testing::Test {
    std::filesystem::path log = test::test_directory() / "run.lcm";

    /// X moves by 10 mm, pauses and moves back. Without `lost`, the log has all messages of steps.
    Analysis there_and_back(std::optional<int> lost, std::int64_t ends_at_steps = 0) const {
        Program program = path_through({{0, 0}, {10, 0}, {0, 0}});
        program.blocks.insert(program.blocks.begin() + 1, {2, Dwell{0.5}});
        {
            LogMaker maker(log);
            maker.position(1, 0, 0);
            maker.job("begun", 0, program);
            maker.job("epoch", 500, program);
            if (lost != 0) { maker.steps("X", 0, 0, even_steps(1000, 200, 500)); }
            if (lost != 1) { maker.steps("X", 1, 500, even_steps(101'000, 200, 500)); }
            if (lost != 2) { maker.steps("X", 2, 1000, even_steps(1'000'000, 200, 1000, -1)); }
            maker.position(0, 1'990'000, ends_at_steps);
            maker.job("ended", 2'000'000, program, "done");
        }
        return analyze_log(log).value();
    }
};

TEST_F(ReportOfLog, CountsDwellsAndMarksThem) {
    const auto report = to_report(there_and_back(std::nullopt));
    const auto& job = report.jobs(0);
    EXPECT_EQ(job.move_count(), 3);
    EXPECT_EQ(job.dwells(), 1);
    ASSERT_EQ(job.moves_size(), 3);
    EXPECT_FALSE(job.moves(0).dwell());
    EXPECT_TRUE(job.moves(1).dwell());
    EXPECT_FALSE(job.moves(0).axes(0).made_unknown());
    EXPECT_THAT(job.axes_not_known(), testing::Not(testing::Contains("X")));
}

TEST_F(ReportOfLog, StepsAreUnknownWhereMessagesAreMissing) {
    for (const int lost : {1, 2}) {
        const auto report = to_report(there_and_back(lost));
        const auto& job = report.jobs(0);
        EXPECT_THAT(job.axes_not_known(), testing::Contains("X")) << lost;
        const auto& cut = job.moves(lost == 1 ? 0 : 2).axes(0);
        EXPECT_LT(cut.made_steps(), cut.asked_steps());
        EXPECT_TRUE(cut.made_unknown()) << lost;
        EXPECT_FALSE(job.moves(lost == 1 ? 2 : 0).axes(0).made_unknown()) << "that move is complete";
    }
}

TEST_F(ReportOfLog, StepsThatWereNotMadeAreKnown) {
    const Program program = path_through({{0, 0}, {10, 0}});
    {
        LogMaker maker(log);
        maker.position(1, 0, 0);
        maker.job("begun", 0, program);
        maker.job("epoch", 500, program);
        maker.steps("X", 0, 0, even_steps(1000, 200, 990));
        maker.position(0, 1'990'000, 990);
        maker.position(1, 1'990'000, 0);
        maker.job("ended", 2'000'000, program, "done");
    }
    const auto report = to_report(analyze_log(log).value());
    EXPECT_EQ(report.jobs(0).moves(0).axes(0).made_steps(), 990);
    EXPECT_FALSE(report.jobs(0).moves(0).axes(0).made_unknown());
}

TEST_F(ReportOfLog, CurveEndsAtTheLastStepIfLaterOnesAreNotInTheLog) {
    const auto whole = position_curves(there_and_back(std::nullopt)).at(0);
    EXPECT_THAT(whole.missing, IsEmpty());
    const Analysis cut = there_and_back(2, 0);
    const auto curve = position_curves(cut).at(0);
    ASSERT_EQ(curve.missing.size(), 1U);
    EXPECT_DOUBLE_EQ(curve.missing[0].from, cut.seconds_at(cut.axes[0]->statistics().last()->tick));
    EXPECT_NEAR(curve.value.back(), 10, 0.01) << "it does not go on at rest";
}

}  // namespace
}  // namespace lockstep::analysis
