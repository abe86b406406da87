// The checks of the ownership detect errors: each test falsifies a correct takeover in one place.
#include <gtest/gtest.h>

#include "tests/simulation/simtest/check/checks.hpp"
#include "tests/simulation/simtest/checks_rig.hpp"
#include "tests/simulation/simtest/run/play/play.hpp"

namespace lockstep::simtest {
namespace {

/// The owner ends in frame 3 of its first job. The standby runs the second job.
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

class OwnerChecks : public testing::Test {
protected:
    void SetUp() override {
        const Played played = play(takeover());
        ASSERT_TRUE(played.violations.empty()) << played.violations[0].text;
        recording = played.recording;
        ASSERT_TRUE(check_all(recording).empty());
        first = recording.epochs.begin()->first;
        last = recording.epochs.rbegin()->first;
        ASSERT_LT(recording.epochs.at(first).writer, recording.epochs.at(last).writer) << "no takeover";
    }
    /// The last track of an epoch that an axis ran.
    Track& track_of(std::size_t axis, Epoch epoch) {
        auto& tracks = recording.motors[axis].tracks;
        return *std::find_if(tracks.rbegin(), tracks.rend(), [&](const Track& t) { return t.epoch == epoch; });
    }
    bool detected() const { return has(check_owners(recording), "owners"); }

    Recording recording;
    Epoch first = 0;
    Epoch last = 0;
};

TEST_F(OwnerChecks, DetectAnAxisThatMovesForTheOldOwnerWhileAnotherMovesForTheNew) {
    const Track& moved = track_of(0, last);
    track_of(1, first).commanded_ticks = moved.commanded + Ticks{1} - track_of(1, first).commanded;
    EXPECT_TRUE(detected());
}

TEST_F(OwnerChecks, DetectAnOldOwnerThatReturns) {
    const Term old = recording.epochs.at(first).writer;
    recording.epochs.at(last).writer = {old.number - 1, old.coordinator};
    EXPECT_TRUE(detected());
}

TEST_F(OwnerChecks, DetectATermThatDecreases) {
    auto& followed = recording.motors[0].followed;
    followed.push_back({recording.ended, followed.back().process, recording.epochs.at(first).writer});
    EXPECT_TRUE(detected());
}

TEST_F(OwnerChecks, DetectAnAxisThatChangesItsOwnerInMotion) {
    const Track& moved = track_of(0, last);
    auto& followed = recording.motors[0].followed;
    const Term higher{followed.back().term.number + 1, 1};
    followed.push_back({moved.commanded + Ticks{1}, followed.back().process, higher});
    EXPECT_TRUE(detected());
}

TEST_F(OwnerChecks, DetectAnAxisMovedByAnOwnerThatItDoesNotFollowYet) {
    recording.motors[0].followed.back().at = recording.ended;
    EXPECT_TRUE(detected());
}

TEST_F(OwnerChecks, DetectAnEpochBegunBeforeAllAxesFollow) {
    recording.motors[0].followed.back().at = recording.epochs.at(last).first_sent + Ticks{1};
    EXPECT_TRUE(detected());
}

TEST_F(OwnerChecks, DetectAFrameRunAgainMuchLater) {
    recording.motors[0].tracks.push_back(track_of(0, first));
    EXPECT_TRUE(detected());
}

TEST_F(OwnerChecks, DetectAFrameRunDifferentlyThanSent) {
    track_of(1, last).to.raw += 1;
    EXPECT_TRUE(detected());
}

TEST_F(OwnerChecks, DetectAHomingWithoutOrder) {
    recording.motors[1].orders.clear();
    EXPECT_TRUE(detected());
}

TEST_F(OwnerChecks, DetectATakeoverFromAHealthyOwner) {
    recording.faults.clear();
    EXPECT_TRUE(detected());
}

}  // namespace
}  // namespace lockstep::simtest
