#include "clients/session/job_result.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

constexpr Term kAsked{1000, 900};
constexpr Term kLater{2000, 950};

JobResult result(std::uint64_t job, std::optional<JobOutcome> outcome, const Term& term = kAsked,
                 const Term& begun = kAsked) {
    return result_of({.term = term, .job = job, .outcome = outcome, .job_begun = begun}, 5, kAsked, kAsked);
}

TEST(JobResult, IsTheCoordinatorsOutcomeOfThatJob) {
    EXPECT_EQ(result(5, std::nullopt), JobResult::InProgress);
    EXPECT_EQ(result(5, JobOutcome::Done), JobResult::Done);
    EXPECT_EQ(result(5, JobOutcome::Stopped), JobResult::Stopped);
    EXPECT_EQ(result(5, JobOutcome::Failed), JobResult::Failed);
}

TEST(JobResult, IsNotThatOfTheJobBefore) {  // published before the reply, received after it
    EXPECT_EQ(result(4, JobOutcome::Done), JobResult::InProgress);
}

TEST(JobResult, IsUnknownAfterAnotherJobOrCoordinator) {
    EXPECT_EQ(result(6, JobOutcome::Done), JobResult::Lost);
    EXPECT_EQ(result(0, std::nullopt, kLater), JobResult::Lost) << "restarted";
}

TEST(JobResult, IsOpenWhileAnotherOwnerContinuesIt) {
    EXPECT_EQ(result(5, std::nullopt, kLater), JobResult::InProgress);
    EXPECT_EQ(result(5, std::nullopt, kLater, kLater), JobResult::Lost) << "a job of its own, of the same number";
    const MachineState stopped{.term = kLater, .job = 5, .outcome = JobOutcome::Stopped, .job_begun = kAsked};
    EXPECT_EQ(result_of(stopped, 5, kAsked, kLater), JobResult::Stopped) << "by a command, after it had continued";
}

TEST(JobResult, IsCutShortIfAStandbyTookOver) {
    EXPECT_EQ(result(5, JobOutcome::Stopped, kLater), JobResult::CutShort);
    EXPECT_EQ(result(5, JobOutcome::Done, kLater), JobResult::Done) << "as the last owner reported";
}

}  // namespace
}  // namespace lockstep
