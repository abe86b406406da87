#include "clients/session/job_verdict.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

constexpr Term kAsked{1000, 900};
constexpr Term kLater{2000, 950};

JobVerdict verdict(std::uint64_t job, std::optional<JobOutcome> outcome, const Term& term = kAsked,
                   const Term& begun = kAsked) {
    return verdict_of({.term = term, .job = job, .outcome = outcome, .job_begun = begun}, 5, kAsked, kAsked);
}

TEST(JobVerdict, IsWhatTheCoordinatorSaysOfThatJob) {
    EXPECT_EQ(verdict(5, std::nullopt), JobVerdict::InProgress);
    EXPECT_EQ(verdict(5, JobOutcome::Done), JobVerdict::Done);
    EXPECT_EQ(verdict(5, JobOutcome::Stopped), JobVerdict::Stopped);
    EXPECT_EQ(verdict(5, JobOutcome::Failed), JobVerdict::Failed);
}

TEST(JobVerdict, IsNotThatOfTheJobBefore) {  // said before the reply, heard after it
    EXPECT_EQ(verdict(4, JobOutcome::Done), JobVerdict::InProgress);
}

TEST(JobVerdict, IsUnknownAfterAnotherJobOrCoordinator) {
    EXPECT_EQ(verdict(6, JobOutcome::Done), JobVerdict::Lost);
    EXPECT_EQ(verdict(0, std::nullopt, kLater), JobVerdict::Lost) << "started anew";
}

TEST(JobVerdict, IsOpenWhileAnotherOwnerGoesOnWithIt) {
    EXPECT_EQ(verdict(5, std::nullopt, kLater), JobVerdict::InProgress);
    EXPECT_EQ(verdict(5, std::nullopt, kLater, kLater), JobVerdict::Lost) << "a job of its own, of the same number";
    const MachineState stopped{.term = kLater, .job = 5, .outcome = JobOutcome::Stopped, .job_begun = kAsked};
    EXPECT_EQ(verdict_of(stopped, 5, kAsked, kLater), JobVerdict::Stopped) << "by somebody, after it had gone on";
}

TEST(JobVerdict, IsCutShortWhereAStandbyTookOver) {
    EXPECT_EQ(verdict(5, JobOutcome::Stopped, kLater), JobVerdict::CutShort);
    EXPECT_EQ(verdict(5, JobOutcome::Done, kLater), JobVerdict::Done) << "the last owner had said so";
}

}  // namespace
}  // namespace lockstep
