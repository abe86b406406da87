// The recorded events of a job come in order, across a takeover, and those after its end are found.
#include "clients/verification/events/recorded_events.hpp"

#include <gtest/gtest.h>

#include "clients/verification/events/switched_off.hpp"
#include "clients/verification/jobs/first_job.hpp"
#include "clients/verification/jobs/newest_epochs.hpp"

namespace lockstep::verification {
namespace {

program_event_t recorded(std::int64_t job, std::int64_t coordinator, const std::string& kind, bool of_program = true) {
    program_event_t event{};
    event.job = job;
    event.coordinator = coordinator;
    event.kind = kind;
    event.of_program = of_program ? 1 : 0;
    return event;
}

TEST(RecordedEvents, OfAJobThatWasTakenOverComeInTheOrderOfItsCoordinators) {
    RecordedEvents events;
    events.take(recorded(3, 20, "flood-on"));
    events.take(recorded(3, 10, "mist-on"));
    events.begin(3, 10);
    events.continue_by(20);
    ASSERT_NE(events.next(), nullptr);
    EXPECT_EQ(events.next()->kind, "mist-on");
    EXPECT_TRUE(events.is_of_first(*events.next()));
    events.pop();
    EXPECT_EQ(events.next()->kind, "flood-on");
    EXPECT_TRUE(events.was_taken_over());
    events.pop();
    EXPECT_EQ(events.next(), nullptr);
}

TEST(RecordedEvents, AfterTheEndOfAJobAreTakenOnce) {
    RecordedEvents events;
    events.begin(3, 10);
    events.end();
    events.take(recorded(3, 10, "output-off", false));
    EXPECT_EQ(events.take_later_ends(3).size(), 0U) << "job 3 itself has not begun again";
    EXPECT_EQ(events.take_later_ends(4).size(), 1U);
    EXPECT_EQ(events.take_later_ends(4).size(), 0U);
}

TEST(RecordedEvents, OfAProgramThatWasNotRunAreLeft) {
    RecordedEvents events;
    events.take(recorded(3, 10, "flood-on"));
    EXPECT_EQ(events.left_of(20), nullptr);
    ASSERT_NE(events.left_of(10), nullptr);
    EXPECT_EQ(events.left_of(10)->job, 3);
}

class JobThatFailed : public testing::Test {
protected:
    JobThatFailed() { recorded_events.begin(3, 10); }

    void check() { switched_off.check(JobOutcome::Failed); }

    Findings findings;
    EventFindings of_events{findings, "job 3", 0};
    RecordedEvents recorded_events;
    KnownDevices devices;
    SwitchedOff switched_off{recorded_events, devices, of_events};
};

TEST_F(JobThatFailed, MustHaveSwitchedOffWhatWasOn) {
    devices.apply({.kind = ProgramEvent::Kind::FloodOn});
    check();
    ASSERT_TRUE(findings.difference);
    EXPECT_EQ(findings.difference->text, "coolant-off is not recorded at the job's end");
}

TEST_F(JobThatFailed, MustNotHaveSwitchedOffWhatWasOff) {
    recorded_events.take(recorded(3, 10, "spindle-stop", false));
    check();
    ASSERT_TRUE(findings.difference);
    EXPECT_EQ(findings.difference->text, "spindle-stop is recorded at the job's end, but it was off");
}

TEST_F(JobThatFailed, IsExactIfItSwitchedOffWhatWasOn) {
    devices.apply({.kind = ProgramEvent::Kind::FloodOn});
    recorded_events.take(recorded(3, 10, "coolant-off", false));
    check();
    EXPECT_TRUE(findings.is_exact());
    EXPECT_EQ(findings.events, 1);
    EXPECT_FALSE(devices.state().flood);
}

TEST_F(JobThatFailed, MayHaveSwitchedOffAnythingIfTheDevicesAreNotKnown) {
    devices.lose();
    recorded_events.take(recorded(3, 10, "spindle-stop", false));
    check();
    EXPECT_TRUE(findings.is_exact());
}

TEST(NewestEpochs, NameTheJobOfAnEpochAndForgetTheOldest) {
    NewestEpochs epochs;
    for (Epoch epoch = 1; epoch <= 20; ++epoch) { epochs.begin(epoch, "job " + std::to_string(epoch)); }
    EXPECT_EQ(epochs.label_of(20), "job 20");
    EXPECT_EQ(epochs.label_of(1), "");
    epochs.lose(20);
    EXPECT_TRUE(epochs.is_lost(20));
    EXPECT_FALSE(epochs.is_lost(19));
}

TEST(FirstJob, OfALogThatBeginsLateIsTheFirstWhoseBeginningItHas) {
    Findings findings;
    FirstJob first;
    first.begin_late();
    analysis::RecordedJob record;
    record.job = 7;
    record.event = "epoch";
    record.epoch = 30;
    EXPECT_FALSE(first.take(record)) << "job 7 began before the log";
    EXPECT_TRUE(first.is_never_known(31));
    record.job = 8;
    record.event = "begun";
    EXPECT_TRUE(first.take(record));
    record.event = "epoch";
    record.epoch = 31;
    EXPECT_TRUE(first.take(record));
    EXPECT_TRUE(first.is_behind(30));
    EXPECT_FALSE(first.is_behind(31));
    first.note(findings);
    ASSERT_EQ(findings.notes.size(), 1U);
    EXPECT_TRUE(findings.notes.front().contains("applies from job 8 on"));
}

}  // namespace
}  // namespace lockstep::verification
