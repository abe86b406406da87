// If the log of a good run is cut at a message, the rest is exact and the missing part is unknown. A healthy run is
// never rated bad, and a part that the log lacks is never rated good.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "clients/analysis/findings.hpp"
#include "clients/verification/verification.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

namespace fs = std::filesystem;
using analysis::Grade;
using test::AlteredLog;
using testing::HasSubstr;

/// The log has homing, a job that is held and resumed, moves of the axes on their own, and another job. The parameter
/// is a share of all messages, so that the shares are tested in parallel.
class CutLog : public testing::TestWithParam<std::ptrdiff_t> {
protected:
    static constexpr std::ptrdiff_t kShares = 12;
    static constexpr std::ptrdiff_t kEvery = 11;  // every eleventh message; two axes and the coordinator alternate

    static void SetUpTestSuite() {
        original = fs::path(testing::TempDir()) / ("lockstep_cut_" + std::to_string(getpid()) + ".lcm");
        const MachineSetup machine = test::example("two-axis");
        {
            test::RecordedMachine recorded(machine, original);
            recorded.home();
            recorded.begin(test::program_of(machine, "G21 G90 F4000\nG1 X60 Y8\nX5 Y15\n"));
            recorded.advance_ms(600);
            recorded.command(CommandKind::Hold);
            ASSERT_TRUE(recorded.reaches(MachinePhase::Holding));
            recorded.advance_ms(700);
            recorded.command(CommandKind::Resume);
            ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
            recorded.begin_own(parse_gcode("G0 X40 Y40\n", gcode_setup(machine, {5, 15}, "own")).value());
            ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
            recorded.advance_ms(700);
            recorded.begin(parse_gcode("G0 X20 Y8\n", gcode_setup(machine, {40, 40}, "last.gcode")).value());
            ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
            recorded.advance_ms(1000);
        }
        whole.emplace(original);
        steps = verify_log(original).value().steps;
    }
    static void TearDownTestSuite() { fs::remove(original); }

    /// Calls `look` for each message of this share, with the log from this message on, or up to it.
    void for_each_cut(bool begins_late, const std::function<void(const fs::path&)>& look) const {
        const auto path = test::test_directory() / "cut.lcm";
        const auto events = std::ssize(whole->events());
        for (auto at = kEvery * GetParam(); at < events && !HasFailure(); at += kEvery * kShares) {
            SCOPED_TRACE((begins_late ? "from message " : "up to message ") + std::to_string(at));
            AlteredLog log = *whole;
            const auto cut = log.events().begin() + at;
            begins_late ? log.events().erase(log.events().begin(), cut) : log.events().erase(cut, log.events().end());
            look(log.write(path));
        }
    }
    static inline fs::path original;
    static inline std::optional<AlteredLog> whole;
    static inline std::int64_t steps = 0;
};

std::optional<Findings> verify_if_it_holds_anything(const fs::path& log) {
    auto found = verify_log(log);
    if (found) { return std::move(*found); }
    EXPECT_THAT(found.error(), HasSubstr("it contains no step, run or job"));
    return std::nullopt;
}

std::string all_of(const analysis::Analysis& analyzed) {
    std::string text;
    for (const auto& finding : analysis::findings(analyzed)) {
        text += std::string(name_of(finding.grade)) + " " + finding.text + "\n";
    }
    return text;
}

TEST_P(CutLog, ThatBeginsLateIsExactFromItsBeginningOnOrUnknown) {
    for_each_cut(true, [](const fs::path& log) {
        const auto found = verify_if_it_holds_anything(log);
        if (!found) { return; }
        EXPECT_FALSE(found->difference) << to_text(*found);
        EXPECT_TRUE(found->end.missing.empty()) << to_text(*found);
        EXPECT_LE(found->steps, steps);
        EXPECT_EQ(found->is_exact(), found->unknown.empty());
        if (found->jobs == 0) { EXPECT_TRUE(!found->is_exact() || found->runs == 0) << to_text(*found); }
    });
}

TEST_P(CutLog, ThatEndsEarlyIsExactIfItsJobsEndedElseUnknown) {
    for_each_cut(false, [](const fs::path& log) {
        if (fs::file_size(log) == 0) { return; }
        const auto found = verify_if_it_holds_anything(log);
        if (!found) { return; }
        EXPECT_FALSE(found->difference) << to_text(*found);
        EXPECT_TRUE(found->end.missing.empty()) << to_text(*found);
        EXPECT_THAT(to_text(*found), HasSubstr("the end of coordinator"));
    });
}

TEST_P(CutLog, AnalysisNeverRatesItBad) {
    for (const bool begins_late : {true, false}) {
        for_each_cut(begins_late, [](const fs::path& log) {
            const auto found = analysis::analyze_log(log);
            if (!found) { return; }
            EXPECT_NE(worst_grade(analysis::findings(*found)), Grade::Bad) << all_of(*found);
            EXPECT_LT(found->largest_distance_mm.value_or(0), 0.02) << all_of(*found);
        });
    }
}

INSTANTIATE_TEST_SUITE_P(AtEachMessageOfAShare, CutLog, testing::Range(std::ptrdiff_t{0}, std::ptrdiff_t{12}));

}  // namespace
}  // namespace lockstep::verification
