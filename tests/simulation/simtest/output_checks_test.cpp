// The checks of outputs detect errors: each test falsifies a correct recording in one place.
#include <gtest/gtest.h>

#include "tests/simulation/simtest/check/checks.hpp"
#include "tests/simulation/simtest/checks_rig.hpp"
#include "tests/simulation/simtest/run/play/play.hpp"

namespace lockstep::simtest {
namespace {

using Word = ProgramEvent::Kind;
using ChannelKind = ChannelEvent::Kind;

/// A laser burns along two moves, and a valve opens at the corner and closes at the end.
Scenario engraving(std::vector<Interrupt> interrupts = {}) {
    Scenario scenario = two_axes();
    scenario.machine.outputs = {
        {.name = "laser",
         .motor = "X",
         .use = OutputUse::Spindle,
         .pwm = PwmConfig{.hz = 5000, .full_scale = 1000, .follows_speed = true},
         .stays_at_interruption = false},
        {.name = "valve", .motor = "Y", .number = 0},
    };
    scenario.tasks[0].program.blocks = {{1, ProgramEvent{.kind = Word::SpindleReverse, .value = 400}},
                                        {2, ProgramMove{{18, 14}, 20}},
                                        {3, ProgramEvent{.kind = Word::OutputOn}},
                                        {4, ProgramMove{{18, 20}, 20}},
                                        {5, ProgramEvent{.kind = Word::OutputOff}}};
    scenario.tasks[0].interrupts = std::move(interrupts);
    return scenario;
}

class OutputChecks : public testing::Test {
protected:
    explicit OutputChecks(const Scenario& scenario = engraving()) : recording(play(scenario).recording) {}

    void SetUp() override {
        ASSERT_EQ(recording.jobs.size(), 2U);
        ASSERT_TRUE(check_all(recording).empty()) << check_all(recording)[0].text;
    }
    bool detected() const { return has(check_outputs(recording, follow_all(recording)), "outputs"); }
    /// The events of one kind at a motor's device.
    std::vector<ChannelEvent*> events(std::size_t motor, ChannelKind kind) {
        std::vector<ChannelEvent*> found;
        for (ChannelEvent& event : recording.motors[motor].channels) {
            if (event.kind == kind) { found.push_back(&event); }
        }
        return found;
    }
    void drop(std::size_t motor, const ChannelEvent* event) {
        auto& all = recording.motors[motor].channels;
        all.erase(all.begin() + (event - all.data()));
    }

    Recording recording;
};

TEST_F(OutputChecks, DetectAValveThatOpensLate) {
    ASSERT_EQ(events(1, ChannelKind::Digital).size(), 2U);
    events(1, ChannelKind::Digital)[0]->tick += Ticks{2000};
    EXPECT_TRUE(detected());
}

TEST_F(OutputChecks, DetectAValveThatOpensEarly) {
    events(1, ChannelKind::Digital)[0]->tick += Ticks{-2000};
    EXPECT_TRUE(detected());
}

TEST_F(OutputChecks, DetectAValveThatDoesNotOpen) {
    drop(1, events(1, ChannelKind::Digital)[0]);
    EXPECT_TRUE(detected());
}

TEST_F(OutputChecks, DetectALaserThatStaysOff) {
    for (auto all = events(0, ChannelKind::Analog); !all.empty(); all = events(0, ChannelKind::Analog)) {
        drop(0, all[0]);
    }
    EXPECT_TRUE(detected());
}

TEST_F(OutputChecks, DetectALaserWithTwoPercentLess) {
    for (ChannelEvent* event : events(0, ChannelKind::Analog)) {
        event->value -= event->value / 50;
        event->detail -= event->detail / 50;
    }
    EXPECT_TRUE(detected());
}

TEST_F(OutputChecks, DetectALaserWithTwoPercentMore) {
    for (ChannelEvent* event : events(0, ChannelKind::Analog)) {
        event->value += event->value / 50;
        event->detail += event->detail / 50;
    }
    EXPECT_TRUE(detected());
}

TEST_F(OutputChecks, DetectALaserThatDoesNotSlowDownAtTheCorner) {
    std::int64_t most = 0;
    for (const ChannelEvent* event : events(0, ChannelKind::Analog)) { most = std::max(most, event->value); }
    const auto all = events(0, ChannelKind::Analog);
    for (ChannelEvent* event : std::span(all).subspan(1, all.size() - 2)) {
        event->value = most;
        event->detail = 0;
    }
    EXPECT_TRUE(detected());
}

/// A camera takes pictures along the first move.
class PulseChecks : public OutputChecks {
protected:
    PulseChecks() : OutputChecks(photographing()) {}
    static Scenario photographing() {
        Scenario scenario = engraving();
        scenario.machine.outputs.push_back(
            {.name = "camera", .motor = "X", .channel = 1, .use = OutputUse::Places, .number = 1, .pulse_us = 20});
        auto& blocks = scenario.tasks[0].program.blocks;
        blocks.insert(blocks.begin(),
                      {{1, ProgramEvent{Word::PulseSpacing, 1, 0.5}}, {1, ProgramEvent{Word::PulsePlaces, 8, 12}}});
        return scenario;
    }
    bool detected() const { return has(check_pulses(recording, follow_all(recording)), "pulses"); }
};

TEST_F(PulseChecks, DetectAPulseThatIsNotMade) {
    EXPECT_FALSE(detected());
    const auto ends = events(0, ChannelKind::CompareEnds);
    ASSERT_EQ(ends.size(), 1U);
    EXPECT_EQ(ends[0]->detail, 0);
    ends[0]->detail = 1;
    EXPECT_TRUE(detected());
}

TEST_F(PulseChecks, DetectPulsesThatNoWordAsksFor) {
    for (ChannelEvent* event : events(0, ChannelKind::CompareBegins)) { ++event->detail; }
    EXPECT_TRUE(detected());
}

TEST_F(PulseChecks, DetectAWordThatIsNotFollowed) {
    for (const auto kind : {ChannelKind::CompareBegins, ChannelKind::CompareEnds}) { drop(0, events(0, kind)[0]); }
    EXPECT_TRUE(detected());
}

class StoppedOutputChecks : public OutputChecks {
protected:
    StoppedOutputChecks() : OutputChecks(engraving({{.kind = Interrupt::Kind::Stop, .after_s = 0.3, .wrong = {}}})) {}
    void SetUp() override {
        OutputChecks::SetUp();
        ASSERT_EQ(recording.jobs[1].outcome, JobOutcome::Stopped);
        recording.ended += recording.machine.slot_ticks() * 60;
    }
};

TEST_F(StoppedOutputChecks, DetectALaserThatIsOnAfterAStop) {
    EXPECT_FALSE(detected());
    ChannelEvent on = *events(0, ChannelKind::Analog).back();
    on.tick = recording.jobs[1].ended;
    on.value = kFullScale / 10;
    recording.motors[0].channels.push_back(on);
    EXPECT_TRUE(detected());
}

}  // namespace
}  // namespace lockstep::simtest
