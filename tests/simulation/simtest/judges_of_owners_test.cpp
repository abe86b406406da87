// The judge of owners objects: a takeover that is right is tampered with, one wrong at a time.
#include <gtest/gtest.h>

#include "tests/simulation/simtest/check/checks.hpp"
#include "tests/simulation/simtest/judges_rig.hpp"
#include "tests/simulation/simtest/run/play.hpp"

namespace lockstep::simtest {
namespace {

/// The owner ends in its first job, in frame 3; the second job is the standby's.
Scenario takeover() {
    Scenario scenario = two_axes();
    scenario.coordinators = 2;
    Task job = scenario.tasks[0];
    PlannedFault end{.fault = {.kind = VirtualFault::Kind::Crash, .lasts = {1'000'000}}, .frame = 3};
    end.victim = PlannedFault::Victim::Owner;
    scenario.tasks[0].faults = {end};
    scenario.tasks.push_back(job);
    return scenario;
}

class JudgeOfOwners : public testing::Test {
protected:
    void SetUp() override {
        const Played played = play(takeover());
        ASSERT_TRUE(played.violations.empty()) << played.violations[0].text;
        recording = played.recording;
        ASSERT_TRUE(check_all(recording).empty());
        first = recording.epochs.begin()->first;
        last = recording.epochs.rbegin()->first;
        ASSERT_LT(recording.epochs.at(first).writer, recording.epochs.at(last).writer) << "it was taken over";
    }
    /// The last one that an axis ran of an epoch.
    Track& track_of(std::size_t axis, Epoch epoch) {
        auto& tracks = recording.axes[axis].tracks;
        return *std::find_if(tracks.rbegin(), tracks.rend(), [&](const Track& t) { return t.epoch == epoch; });
    }
    bool objects() const { return has(check_owners(recording), "owners"); }

    Recording recording;
    Epoch first = 0;
    Epoch last = 0;
};

TEST_F(JudgeOfOwners, SeesAnAxisThatStillMovesForTheOldOneWhenAnotherIsMovedForTheNew) {
    const Track& moved = track_of(0, last);
    track_of(1, first).commanded_ticks = moved.commanded + Ticks{1} - track_of(1, first).commanded;
    EXPECT_TRUE(objects());
}

TEST_F(JudgeOfOwners, SeesAnOwnerThatComesBack) {
    const Term old = recording.epochs.at(first).writer;
    recording.epochs.at(last).writer = {old.number - 1, old.coordinator};
    EXPECT_TRUE(objects());
}

TEST_F(JudgeOfOwners, SeesATermThatFalls) {
    auto& followed = recording.axes[0].followed;
    followed.push_back({recording.ended, followed.back().process, recording.epochs.at(first).writer});
    EXPECT_TRUE(objects());
}

TEST_F(JudgeOfOwners, SeesAnAxisThatFollowsAnotherOwnerInMotion) {
    const Track& moved = track_of(0, last);
    auto& followed = recording.axes[0].followed;
    const Term higher{followed.back().term.number + 1, 1};
    followed.push_back({moved.commanded + Ticks{1}, followed.back().process, higher});
    EXPECT_TRUE(objects());
}

TEST_F(JudgeOfOwners, SeesAnAxisMovedByAnOwnerThatItDoesNotFollowYet) {
    recording.axes[0].followed.back().at = recording.ended;
    EXPECT_TRUE(objects());
}

TEST_F(JudgeOfOwners, SeesAnEpochBegunBeforeAllAxesFollow) {
    recording.axes[0].followed.back().at = recording.epochs.at(last).first_sent + Ticks{1};
    EXPECT_TRUE(objects());
}

TEST_F(JudgeOfOwners, SeesAFrameThatIsRunOnceMoreMuchLater) {
    recording.axes[0].tracks.push_back(track_of(0, first));
    EXPECT_TRUE(objects());
}

TEST_F(JudgeOfOwners, SeesAFrameThatIsRunOtherThanItWasSent) {
    track_of(1, last).to.raw += 1;
    EXPECT_TRUE(objects());
}

TEST_F(JudgeOfOwners, SeesAHomingThatNobodyOrdered) {
    recording.axes[1].orders.clear();
    EXPECT_TRUE(objects());
}

TEST_F(JudgeOfOwners, SeesATakeoverFromAnOwnerThatIsWell) {
    recording.faults.clear();
    EXPECT_TRUE(objects());
}

}  // namespace
}  // namespace lockstep::simtest
