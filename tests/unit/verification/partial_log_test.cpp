// The log of a good run lacks a part. The results that depend on the missing part are unknown, and are rated neither
// good nor bad.
#include <gtest/gtest.h>
#include <unistd.h>

#include <random>

#include "clients/analysis/findings.hpp"
#include "clients/analysis/report.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::analysis {
namespace {

using test::AlteredLog;
using test::RecordedMachine;

class PartialLog : public testing::Test {
protected:
    static void SetUpTestSuite() {
        const MachineSetup machine = test::example("three-axis");
        const std::string name = "lockstep_partial_log." + std::to_string(getpid()) + ".lcm";  // tests run side by side
        whole_ = std::filesystem::path(testing::TempDir()) / name;
        RecordedMachine recorded(machine, whole_);
        recorded.home();
        recorded.advance_ms(1500);
        recorded.begin(test::program_of(machine, "G21 G90 F3000\nG1 X60 Y8 Z50\nX62 Y50\nX10 Y40 Z58\nX60\nX5 Y5\n"));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        recorded.advance_ms(1500);
    }

    static void TearDownTestSuite() { std::filesystem::remove(whole_); }

    /// The analysis of a log with only the events for which `keeps` returns true.
    template <typename Keeps>
    Analysis without(Keeps keeps) const {
        AlteredLog log(whole_);
        std::erase_if(log.events(), [&](const AlteredLog::Event& event) { return !keeps(event); });
        return analyze_log(log.write(test::test_directory() / "partial.lcm")).value();
    }
    static bool is_of(const AlteredLog::Event& event, std::string_view part) {
        return event.channel.find(part) != event.channel.npos;
    }
    static std::string all_of(const Analysis& analysis) {
        std::string text;
        for (const Finding& finding : findings(analysis)) {
            text += std::string(name_of(finding.grade)) + " " + finding.text + "\n";
        }
        return text;
    }
    static void expect_finding(const Analysis& analysis, std::string_view finding) {
        EXPECT_NE(all_of(analysis).find(finding), std::string::npos) << all_of(analysis);
    }

    inline static std::filesystem::path whole_;
};

TEST_F(PartialLog, IsGoodWhereNothingIsMissing) {
    const Analysis whole = without([](const auto&) { return true; });
    EXPECT_EQ(worst_grade(findings(whole)), Grade::Good) << all_of(whole);
}

TEST_F(PartialLog, OfOneAxisHasNoPath) {
    const Analysis one = without([](const auto& event) { return !is_of(event, "_Y_") && !is_of(event, "_Z_"); });
    EXPECT_EQ(worst_grade(findings(one)), Grade::Unknown) << all_of(one);
    expect_finding(
        one, "unknown the motion of Y and Z cannot be determined: their steps are not in this log; lockstep log merge");
    EXPECT_LT(one.largest_distance_mm.value_or(0), 0.02) << "only while Y and Z are known to stand still";
}

TEST_F(PartialLog, WithoutTheCoordinatorsRecordHasNoCommandedMotion) {
    const Analysis unasked = without([](const auto& event) { return !is_of(event, "_JOB"); });
    EXPECT_EQ(worst_grade(findings(unasked)), Grade::Unknown) << all_of(unasked);
    expect_finding(unasked, "unknown the commanded motion cannot be determined: the coordinator's record");
    expect_finding(unasked, "good no step of X, Y and Z is missing");
}

TEST_F(PartialLog, ThatBeganInMotionHasNoCommandedMotionOfTheJob) {
    std::int64_t from = 0;
    const Analysis second = without([&](const auto& event) {
        if (is_of(event, "_JOB")) { from = event.utime; }  // up to the job's last epoch
        return true;
    });
    const std::int64_t middle = *second.jobs.back().begun_us + 1'000'000;
    const Analysis late = without([&](const auto& event) { return event.utime >= middle; });
    EXPECT_EQ(worst_grade(findings(late)), Grade::Unknown) << all_of(late);
    expect_finding(late, "cannot be determined: its beginning is not in this log");
    expect_finding(late, "good no step of X, Y and Z is missing since the log began");
    EXPECT_GT(from, middle);
}

TEST_F(PartialLog, OfAnAxisThatFallsSilentInMotionDoesNotKnowItsMoves) {
    const Analysis whole = without([](const auto&) { return true; });
    const std::int64_t middle = *whole.jobs.back().begun_us + 4'000'000;
    const Analysis found = without([&](const auto& event) { return !is_of(event, "_Y_") || event.utime < middle; });
    EXPECT_EQ(worst_grade(findings(found)), Grade::Unknown) << all_of(found);
    expect_finding(found, "not all steps of Y are in this log");
    EXPECT_LT(found.largest_distance_mm.value(), 0.02);
}

TEST_F(PartialLog, WithoutAnAxissRunsDoesNotKnowWhetherItsStepsCameInTime) {
    const Analysis found = without([](const auto& event) { return !is_of(event, "_X_RUN"); });
    EXPECT_EQ(worst_grade(findings(found)), Grade::Unknown) << all_of(found);
    expect_finding(found, "were in time cannot be determined: the times commanded are not in this log");
}

/// A good run is never rated bad, for any missing messages and for any time without them. No distance is measured from
/// an outdated position of an axis.
TEST_F(PartialLog, NeverTakesMissingMessagesForAFault) {
    std::mt19937 random(5);
    const Analysis whole = without([](const auto&) { return true; });
    const std::int64_t begun = *whole.jobs.back().begun_us;
    const auto instant = [&] { return begun + static_cast<std::int64_t>(random() % 7'000) * 1000 - 500'000; };
    constexpr std::array<std::string_view, 10> kParts{"_X_",      "_Y_",    "_Z_",       "_X_STEPS", "_Y_STEPS",
                                                      "_Z_STEPS", "_X_RUN", "_POSITION", "_JOB",     "LOCKSTEP"};
    for (int i = 0; i < 150; ++i) {
        const std::string_view part = kParts[random() % kParts.size()];
        const auto [from, to] = std::minmax({instant(), instant()});
        const bool is_inside = random() % 2 == 0;
        const Analysis found = without([&, from = from, to = to](const auto& event) {
            const bool is_between = from <= event.utime && event.utime < to;
            return !is_of(event, part) || is_between != is_inside;
        });
        SCOPED_TRACE(std::string(part) + (is_inside ? " within " : " without ") + std::to_string(from - begun) +
                     " to " + std::to_string(to - begun));
        EXPECT_NE(worst_grade(findings(found)), Grade::Bad) << all_of(found);
        EXPECT_LT(found.largest_distance_mm.value_or(0), 0.02) << all_of(found);
        if (testing::Test::HasFailure()) { return; }
    }
}

}  // namespace
}  // namespace lockstep::analysis
