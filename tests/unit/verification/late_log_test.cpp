// A log that begins later than the machine is verified from its beginning on. Only messages missing in between count.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "clients/verification/verification.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

namespace fs = std::filesystem;
using test::AlteredLog;
using testing::HasSubstr;

class LateLog : public testing::Test {
protected:
    static void SetUpTestSuite() {
        const std::string name = "lockstep_late_" + std::to_string(getpid()) + ".lcm";  // tests run side by side
        original = fs::path(testing::TempDir()) / name;
        test::RecordedMachine recorded(test::example("two-axis"), original);
        recorded.home();
        const MachineSetup& machine = recorded.vm().machine();
        for (const char* line : {"G90 F3000\nG1 X70\nX5 Y5\n\n", "G21 G90 F3000\nG1 X20 Y30\n"}) {
            recorded.begin(test::program_of(machine, line));
            ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
            recorded.advance_ms(1500);
        }
    }
    static void TearDownTestSuite() { fs::remove(original); }

    Findings begun_at(std::int64_t utime) {
        std::erase_if(log.events(), [&](const AlteredLog::Event& event) { return event.utime < utime; });
        return verified();
    }
    Findings verified() {
        const auto findings = verify_log(log.write(test::test_directory() / "late.lcm"));
        EXPECT_TRUE(findings.has_value()) << findings.error();
        return findings.value_or(Findings{});
    }
    std::int64_t begin_of_job(std::int64_t number) {
        std::int64_t utime = 0;
        log.change<job_t>("_JOB", [&](const job_t& job) {
            if (job.job == number && job.event == "begun") { utime = job.utime; }
            return false;
        });
        return utime;
    }

    static inline fs::path original;
    AlteredLog log{original};
};

TEST_F(LateLog, BegunBetweenJobsIsExactFromTheNextJobOn) {
    const Findings findings = begun_at(begin_of_job(3) - 500'000);
    EXPECT_TRUE(findings.is_exact()) << to_text(findings);
    EXPECT_EQ(findings.jobs, 1);
    EXPECT_GT(findings.steps, 1000);
    EXPECT_THAT(to_text(findings), HasSubstr("the result applies from job 3 on"));
}

TEST_F(LateLog, BegunWithinAJobIsExactFromTheNextJobOn) {
    const Findings findings = begun_at(begin_of_job(2) + 1'000'000);
    EXPECT_TRUE(findings.is_exact()) << to_text(findings);
    EXPECT_EQ(findings.jobs, 1);
    EXPECT_THAT(to_text(findings), HasSubstr("the result applies from job 3 on"));
}

TEST_F(LateLog, FindsMessagesMissingInBetween) {
    const std::int64_t at = begin_of_job(2) + 1'000'000;
    ASSERT_EQ(log.leave_out<run_t>("_X_RUN",
                                   [&, seen = 0](const run_t& run) mutable { return run.utime > at && ++seen == 3; }),
              1U);
    const Findings findings = begun_at(at);
    EXPECT_FALSE(findings.is_exact());
    EXPECT_THAT(to_text(findings), HasSubstr("log merge"));
}

TEST_F(LateLog, AStepThatIsMissingAfterItsBeginningIsFound) {
    const std::int64_t at = begin_of_job(3) - 500'000;
    ASSERT_EQ(log.leave_out<step_batch_t>(
                  "_Y_STEPS", [&, seen = 0](const auto& batch) mutable { return batch.utime > at && ++seen == 1; }),
              1U);
    EXPECT_FALSE(begun_at(at).is_exact()) << "the first message of steps in the log";
}

TEST_F(LateLog, AJobWhoseBeginningIsMissingAfterItsBeginningIsFound) {
    const std::int64_t at = begin_of_job(3) - 500'000;
    ASSERT_EQ(log.leave_out<job_t>("_JOB", [&](const job_t& job) { return job.job == 3 && job.event == "begun"; }), 1U);
    const Findings findings = begun_at(at);
    EXPECT_FALSE(findings.is_exact());
    EXPECT_THAT(to_text(findings), HasSubstr("1 messages of jobs are missing"));
}

}  // namespace
}  // namespace lockstep::verification
