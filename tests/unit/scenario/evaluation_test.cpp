// Each expectation holds if the record agrees, fails if it does not, and reports the result and its source.
#include "clients/scenario/model/evaluation.hpp"

#include <gmock/gmock.h>

#include "tests/unit/scenario/scenario_text.hpp"

namespace lockstep::scenario {
namespace {

using testing::HasSubstr;

/// A good run: X at 10 mm, exact, complete, no vetoes, both axes ended with frame 7.
Evidence good() {
    Evidence evidence;
    evidence.verified->set_exact(true);
    evidence.merged->set_complete(true);
    proto::AxisAnalysis& axis = *evidence.analysis->add_axes();
    axis.set_name("X");
    axis.set_position_end_mm(10);
    evidence.analysis->set_largest_distance_mm(0.01);
    evidence.record.epochs[3] = {{"X", {7, false}}, {"Y", {7, false}}};
    evidence.record.rests = {{"X", {{{0}, {100}}, {{5000}, {9000}}}}, {"Y", {{{0}, {6000}}, {{7000}, {9000}}}}};
    return evidence;
}

Observations good_observations() {
    Observations observed;
    observed.status.set_phase("Idle");
    proto::AxisStatus& axis = *observed.status.add_axes();
    axis.set_name("X");
    axis.set_present(true);
    axis.set_homed(true);
    return observed;
}

std::vector<Check> checks(const std::string& expect, const Evidence& evidence,
                          const Observations& observed = good_observations()) {
    return evaluate(parsed(whole("expect { " + expect + " }")), observed, evidence);
}

/// The first check. Expectations come before the checks that are always made.
Check check(const std::string& expect, const Evidence& evidence, const Observations& observed = good_observations()) {
    return checks(expect, evidence, observed).front();
}

bool holds(const std::string& expect, const Evidence& evidence, const Observations& observed = good_observations()) {
    return check(expect, evidence, observed).held();
}

TEST(ScenarioEvaluation, ComparesFinalPositionToTheStepUnlessToleranceIsGiven) {
    EXPECT_TRUE(holds("final { axis: \"X\" mm: 10 }", good()));
    EXPECT_FALSE(holds("final { axis: \"X\" mm: 10.0125 }", good())) << "a step away";
    EXPECT_TRUE(holds("final { axis: \"X\" mm: 10.0125 within_mm: 0.02 }", good()));
    const Check altered = check("final { axis: \"X\" mm: 11 }", good());
    EXPECT_THAT(altered.found(), HasSubstr("10.0000 mm"));
    EXPECT_THAT(altered.where(), HasSubstr("whole.lcm"));
}

TEST(ScenarioEvaluation, FailsExpectationThatIsNotOnRecord) {
    EXPECT_FALSE(holds("final { axis: \"Y\" mm: 10 }", good()));
    Evidence evidence = good();
    evidence.analysis->clear_largest_distance_mm();
    EXPECT_FALSE(holds("path_within_mm: 1", evidence));
    evidence.analysis = std::unexpected("no log");
    EXPECT_EQ(check("path_within_mm: 1", evidence).found(), "no log");
}

TEST(ScenarioEvaluation, ComparesLargestDistanceFromThePath) {
    EXPECT_TRUE(holds("path_within_mm: 0.0126", good()));
    EXPECT_FALSE(holds("path_within_mm: 0.009", good()));
}

TEST(ScenarioEvaluation, FailsTogetherWhereAxesEndWithDifferentFrames) {
    EXPECT_TRUE(holds("together: \"X\" together: \"Y\"", good()));
    Evidence evidence = good();
    evidence.record.epochs[4] = {{"X", {2, true}}, {"Y", {3, false}}};
    const Check parted = check("together: \"X\" together: \"Y\"", evidence);
    EXPECT_FALSE(parted.held());
    EXPECT_THAT(parted.found(), HasSubstr("X with the tail of frame 2, Y with frame 3"));
}

TEST(ScenarioEvaluation, FailsTogetherWithoutAnyEpoch) {
    Evidence evidence = good();
    evidence.record.epochs.clear();
    EXPECT_FALSE(holds("together: \"X\" together: \"Y\"", evidence));
}

TEST(ScenarioEvaluation, AcceptsVetoesOnlyOfNamedAxes) {
    Evidence evidence = good();
    EXPECT_TRUE(holds("vetoes {}", evidence));
    EXPECT_FALSE(holds("vetoes { by: \"X\" }", evidence));
    evidence.vetoed_by = {"X", "Y"};
    EXPECT_FALSE(holds("vetoes {}", evidence));
    EXPECT_FALSE(holds("vetoes { by: \"X\" }", evidence));
    EXPECT_TRUE(holds("vetoes { by: \"Y\" by: \"X\" }", evidence));
    evidence.vetoed_by = {"Y"};
    EXPECT_TRUE(holds("vetoes { by: \"Y\" by: \"X\" }", evidence)) << "one of the named axes is enough";
}

TEST(ScenarioEvaluation, CountsInterruptionsOfAllJobs) {
    Evidence evidence = good();
    evidence.analysis->add_jobs()->set_interruptions(1);
    evidence.analysis->add_jobs()->set_interruptions(2);
    EXPECT_TRUE(holds("interruptions: 3", evidence));
    EXPECT_FALSE(holds("interruptions: 0", evidence));
}

TEST(ScenarioEvaluation, FindsCauseAmongAllIncidents) {
    Evidence evidence = good();
    EXPECT_EQ(check("cause { kind: \"process-ended\" }", evidence).found(), "no incident is recorded");
    evidence.causes = {{"asked", "", "requested"}, {"process-ended", "axis-Y", "axis Y ended"}};
    EXPECT_TRUE(holds("cause { kind: \"process-ended\" process: \"axis-Y\" }", evidence));
    EXPECT_FALSE(holds("cause { kind: \"process-ended\" process: \"axis-X\" }", evidence));
}

TEST(ScenarioEvaluation, MeasuresRestWhenAllAxesAreAtRest) {
    Observations observed = good_observations();
    const std::int64_t frame = parsed(whole("")).machine.frame_ticks().value;
    Evidence evidence = good();
    evidence.record.rests = {{"X", {{{0}, {frame}}, {{3 * frame}, {9 * frame}}}},
                             {"Y", {{{2 * frame}, {2 * frame + 5}}, {{4 * frame}, {9 * frame}}}}};
    observed.rests = {{"hold", {frame + 1}, 3, {"X", "Y"}}};
    EXPECT_TRUE(holds("", evidence, observed));
    EXPECT_THAT(check("", evidence, observed).found(), HasSubstr("3.00 frames"));
    observed.rests[0].within_frames = 2;
    EXPECT_FALSE(holds("", evidence, observed));
    observed.rests[0].at = {10 * frame};
    EXPECT_FALSE(holds("", evidence, observed)) << "not on record";
}

TEST(ScenarioEvaluation, ComparesAxesAndMachineWithFinalStatus) {
    EXPECT_TRUE(holds("axis { name: \"X\" heard: true }", good()));
    EXPECT_TRUE(holds("axis { name: \"X\" homed: true }", good()));
    EXPECT_TRUE(holds("axis { name: \"X\" fault: \"none\" }", good()));
    EXPECT_FALSE(holds("axis { name: \"X\" fault: \"axis-lost\" }", good()));
    EXPECT_FALSE(holds("axis { name: \"Y\" homed: true }", good())) << "its state is not received";
    EXPECT_TRUE(holds("phase: IDLE", good()));
    EXPECT_FALSE(holds("phase: FAULT", good()));
}

/// The motors of the example gantry end at these places.
Evidence ended_at(double x_mm, double y1_mm, double y2_mm) {
    Evidence evidence = good();
    evidence.analysis->clear_axes();
    for (const auto& [name, mm] : {std::pair{"X", x_mm}, {"Y1", y1_mm}, {"Y2", y2_mm}, {"Z", 58.0}}) {
        proto::AxisAnalysis& motor = *evidence.analysis->add_axes();
        motor.set_name(name);
        motor.set_position_end_mm(mm);
    }
    return evidence;
}

TEST(ScenarioEvaluation, ComputesTheFinalPositionOfAnAxisFromItsMotors) {
    const auto final = [](double mm, const Evidence& evidence) {
        const std::string expect = "expect { final { axis: \"Y\" mm: " + std::to_string(mm) + " } }";
        return evaluate(parsed(of_gantry(expect)), good_observations(), evidence).front();
    };
    EXPECT_TRUE(final(40, ended_at(60, 40, 40)).held());
    EXPECT_FALSE(final(40.0125, ended_at(60, 40, 40)).held()) << "a step away";
    const Check apart = final(40, ended_at(60, 40, 40.025));
    EXPECT_FALSE(apart.held());
    EXPECT_THAT(apart.found(), HasSubstr("mm from where the other motors place it"));
    Evidence lacks = ended_at(60, 40, 40);
    lacks.analysis->mutable_axes(2)->clear_position_end_mm();
    EXPECT_EQ(final(40, lacks).found(), "motor Y2 is not recorded");
}

TEST(ScenarioEvaluation, ComparesAMotorWithItsOwnState) {
    Observations observed = good_observations();
    proto::AxisStatus& motor = *observed.status.add_motors();
    motor.set_name("Y2");
    motor.set_axis("Y");
    motor.set_present(true);
    motor.mutable_fault()->set_name("limit-hit");
    const auto held = [&](const std::string& expect) {
        return evaluate(parsed(of_gantry("expect { " + expect + " }")), observed, good()).front().held();
    };
    EXPECT_TRUE(held("axis { name: \"Y2\" heard: true fault: \"limit-hit\" }"));
    EXPECT_FALSE(held("axis { name: \"Y1\" heard: true }"));
}

TEST(ScenarioEvaluation, RequiresExactAndCompleteRecordByDefault) {
    Evidence evidence = good();
    ASSERT_EQ(checks("", evidence).size(), 2);
    evidence.verified->set_exact(false);
    evidence.verified->mutable_first_difference()->set_text("one step more");
    evidence.merged->set_complete(false);
    EXPECT_FALSE(checks("", evidence)[0].held());
    EXPECT_EQ(checks("", evidence)[0].found(), "one step more");
    EXPECT_FALSE(checks("", evidence)[1].held());
    EXPECT_TRUE(checks("exact: false complete: false", evidence).empty());
}

}  // namespace
}  // namespace lockstep::scenario
