// The zero of a motor moves between its runs only where the record tells why.
#include "clients/verification/positions/zero_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kSlot = 10'000;  // ticks, and microseconds, between positions
constexpr std::int64_t kProcess = 7;

/// A run ends at rest in slot 10 and the next one begins in slot 20. Its zero is 20 steps further.
class MovedZero : public testing::Test {
protected:
    MovedZero() { set_way(HomingWay::BySwitch); }

    void set_way(HomingWay way) {
        MachineSetup machine = test::example("two-axis");
        machine.axes[0].homing.way = way;
        zero.set_machine(machine, "X");
        check.set_machine(machine);
        park_steps = to_steps(machine.axes[0], machine.axes[0].homing.park_mm);
    }
    static analysis::RecordedPosition at(std::int64_t slot) {
        return {.tick = Tick{slot * kSlot}, .incarnation = kProcess, .sequence = slot, .is_homed = true};
    }
    void take_from(std::int64_t from, std::int64_t to) {
        for (std::int64_t slot = from; slot < to; ++slot) { check.take(at(slot)); }
    }
    /// The motor stands `away` steps from its park.
    void take_near_park(std::int64_t from, std::int64_t to, std::int64_t away) {
        for (std::int64_t slot = from; slot < to; ++slot) {
            analysis::RecordedPosition position = at(slot);
            position.steps = park_steps + away;
            check.take(position);
        }
    }
    void take_unhomed(std::int64_t slot) {
        analysis::RecordedPosition position = at(slot);
        position.is_homed = false;
        check.take(position);
    }
    void take_lost(std::int64_t slot, std::int64_t following_error) {
        analysis::RecordedPosition position = at(slot);
        position.following_error = following_error;
        check.take(position);
    }
    static analysis::Run run_in(std::int64_t slot, std::int64_t zero) {
        return {.incarnation = kProcess, .epoch = 5, .frame = 1, .start = Tick{slot * kSlot}, .zero_count = zero};
    }
    void take_runs(std::int64_t before = 10, std::int64_t run = 20) {
        check.take(run_in(before, 100), run_in(run, 120), [] { return "commanded"; });
    }
    void take_homing(std::int64_t begun, std::int64_t ended) {
        job_t job;
        job.kind = "home";
        job.event = "begun";
        job.utime = begun * kSlot;
        homings.take(analysis::RecordedJob(job));
        job.event = "ended";
        job.utime = ended * kSlot;
        homings.take(analysis::RecordedJob(job));
    }
    static constexpr const char* kWithoutReason = "without a reason";
    static constexpr const char* kLacksMessages = "the log lacks messages that may tell why";

    /// The result for each change of the zero that is not told.
    std::vector<std::string> found(bool lacks_jobs = false) {
        std::vector<std::string> all;
        for (const ZeroCheck::Change& moved : check.finish(homings, lacks_jobs)) {
            all.push_back(moved.why_unknown.empty() ? kWithoutReason : moved.why_unknown);
        }
        return all;
    }

    analysis::MotorZero zero;
    ZeroCheck check{zero};
    HomingJobs homings;
    std::int64_t park_steps = 0;
};

TEST_F(MovedZero, WithoutAReasonIsADifference) {
    take_from(0, 30);
    take_runs();
    const auto moved = check.finish(homings, false);
    ASSERT_EQ(moved.size(), 1U);
    EXPECT_EQ(moved[0].text, "frame 1 counts from 120 of its device, but the run before it from 100");
    EXPECT_EQ(moved[0].change, 20);
    EXPECT_EQ(moved[0].commanded, "commanded");
    EXPECT_EQ(moved[0].why_unknown, "");
}

TEST_F(MovedZero, MayBeOfAHoming) {
    take_from(0, 12);
    take_unhomed(12);
    take_from(13, 30);
    take_runs();
    EXPECT_THAT(found(), IsEmpty());
}

TEST_F(MovedZero, IsNotOfAnEarlierHoming) {
    take_from(0, 7);
    take_unhomed(7);
    take_from(8, 30);
    take_runs();
    EXPECT_THAT(found(), ElementsAre(kWithoutReason));
}

TEST_F(MovedZero, IsNotOfALaterHoming) {
    take_from(0, 22);
    take_unhomed(22);
    take_from(23, 30);
    take_runs();
    EXPECT_THAT(found(), ElementsAre(kWithoutReason));
}

TEST_F(MovedZero, OfAMotorThatSearchesItsSwitchNeedsMoreThanAJobOfHoming) {
    take_from(0, 30);
    take_runs();
    take_homing(12, 14);
    EXPECT_THAT(found(), ElementsAre(kWithoutReason));
}

/// It homes in slot 13, so its place changes from 20 steps beyond its park to its park.
class MovedZeroInPlace : public MovedZero {
protected:
    MovedZeroInPlace() {
        set_way(HomingWay::InPlace);
        take_near_park(0, 13, 20);
        take_runs();
    }
};

TEST_F(MovedZeroInPlace, IsOfAHoming) {
    take_near_park(13, 60, 0);
    take_homing(12, 14);
    EXPECT_THAT(found(), IsEmpty());
}

TEST_F(MovedZeroInPlace, NeedsAJobOfHoming) {
    take_near_park(13, 60, 0);
    take_homing(22, 24);
    EXPECT_THAT(found(), ElementsAre(kWithoutReason));
}

TEST_F(MovedZeroInPlace, NeedsAJumpToThePark) {
    take_near_park(13, 60, 1);
    take_homing(12, 14);
    EXPECT_THAT(found(), ElementsAre(kWithoutReason));
}

TEST_F(MovedZeroInPlace, IsUnknownWithoutTheJobs) {
    take_near_park(13, 60, 0);
    EXPECT_THAT(found(true), ElementsAre(kLacksMessages));
}

TEST_F(MovedZero, MayBeByTheLostStepsThatWereMadeUp) {
    take_from(0, 5);
    for (std::int64_t slot = 5; slot < 15; ++slot) { take_lost(slot, -20); }
    take_from(15, 30);
    take_runs();
    EXPECT_THAT(found(), IsEmpty());
}

TEST_F(MovedZero, ByOtherStepsThanWereLostIsUnknown) {
    take_from(0, 5);
    for (std::int64_t slot = 5; slot < 15; ++slot) { take_lost(slot, -7); }
    take_from(15, 30);
    take_runs();
    EXPECT_THAT(found(), ElementsAre("the positions show a correction by +7"));
}

TEST_F(MovedZero, ByStepsThatWereStillLostIsADifference) {
    for (std::int64_t slot = 0; slot < 30; ++slot) { take_lost(slot, -20); }
    take_runs();
    EXPECT_THAT(found(), ElementsAre(kWithoutReason));
}

TEST_F(MovedZero, IsUnknownWherePositionsAreMissing) {
    take_from(0, 14);
    take_from(16, 30);
    take_runs();
    EXPECT_THAT(found(), ElementsAre(kLacksMessages));
}

TEST_F(MovedZero, IsUnknownBeforeTheFirstPositionAndBehindTheLastOne) {
    take_from(11, 30);
    take_runs(10, 20);
    take_runs(20, 40);
    EXPECT_THAT(found(), ElementsAre(kLacksMessages, kLacksMessages));
}

TEST_F(MovedZero, IsUnknownInTheNextProcess) {
    take_from(0, 15);
    for (std::int64_t slot = 15; slot < 30; ++slot) {
        analysis::RecordedPosition position = at(slot);
        position.incarnation = kProcess + 1;
        position.sequence -= 15;
        check.take(position);
    }
    take_runs();
    EXPECT_THAT(found(), ElementsAre(kLacksMessages));
}

TEST_F(MovedZero, IsADifferenceAlthoughPositionsOvertakeEachOther) {
    for (std::int64_t slot = 0; slot < 40; slot += 2) {
        check.take(at(slot + 1));
        check.take(at(slot));
        check.take(at(slot));  // twice
    }
    take_runs();
    EXPECT_THAT(found(), ElementsAre(kWithoutReason));
}

TEST_F(MovedZero, IsADifferenceAlthoughRunsComeBeforeTheirPositions) {
    take_runs();
    take_from(0, 30);
    EXPECT_THAT(found(), ElementsAre(kWithoutReason));
}

TEST_F(MovedZero, IsUnknownIfTheEncoderHasShownMoreSinceThanTheCheckKeeps) {
    const auto slots = static_cast<std::int64_t>(ZeroCheck::kMaxReasons) + 20;
    for (std::int64_t slot = 0; slot < slots; ++slot) { take_lost(slot, 1 + slot % 2); }
    take_from(slots, slots + 10);
    take_runs(10, slots + 5);
    EXPECT_THAT(found(), ElementsAre(kLacksMessages));
}

TEST_F(MovedZero, IsNoneIfTheRunsHaveTheSame) {
    take_from(0, 30);
    check.take(run_in(10, 100), run_in(20, 100), [] { return "commanded"; });
    EXPECT_THAT(found(), IsEmpty());
}

}  // namespace
}  // namespace lockstep::verification
