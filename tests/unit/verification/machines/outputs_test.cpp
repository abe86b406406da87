// The changes of outputs on record are those of the frames that were run: each at its tick, and no other.
#include <gtest/gtest.h>

#include <algorithm>

#include "clients/verification/verification.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

using EventKind = ProgramEvent::Kind;

class RecordedOutputs : public testing::Test {
protected:
    static std::filesystem::path path() { return test::test_directory() / "outputs.lcm"; }
    static Block event(EventKind kind, std::int32_t index = 0, double value = 0) {
        return {{}, ProgramEvent{kind, index, value}};
    }
    static Block move(double x, double y) { return {{}, ProgramMove{.target_mm = {x, y}, .feed_mm_s = 50}}; }
    static Program square(double x, double y) {
        return {.name = "burn.gcode",
                .axes = {"X", "Y"},
                .start_mm = {x, y},
                .blocks = {event(EventKind::SpindleReverse, 0, 700), event(EventKind::FloodOn), move(x + 30, y),
                           event(EventKind::OutputOn, 0), move(x + 30, y + 30), event(EventKind::SpindleSpeed, 0, 300),
                           move(x, y + 30), event(EventKind::OutputOff, 0), move(x, y), event(EventKind::SpindleStop),
                           event(EventKind::CoolantOff)}};
    }
    /// Holds and resumes a program, and stops the next one while its laser burns.
    static void record() {
        const MachineSetup machine = test::example("laser");
        const std::vector<double> start = parked_mm(machine);
        test::RecordedMachine recorded(machine, path());
        recorded.home();
        recorded.begin(square(start[0], start[1]));
        for (int k = 0; k < 4; ++k) {
            recorded.advance_ms(270);
            recorded.command(CommandKind::Hold);
            ASSERT_TRUE(recorded.reaches(MachinePhase::Holding));
            recorded.command(CommandKind::Resume);
        }
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        recorded.begin(square(start[0], start[1]));
        recorded.advance_ms(900);
        recorded.command(CommandKind::Stop);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        recorded.advance_ms(500);
    }
    static Findings altered(std::int64_t sequence, const std::function<void(channel_event_t&)>& change) {
        test::AlteredLog log(path());
        EXPECT_EQ(log.change<channel_event_t>("_X_CHANNELS",
                                              [&](channel_event_t& event) {
                                                  if (event.sequence != sequence) { return false; }
                                                  change(event);
                                                  return true;
                                              }),
                  1);
        return verify_log(log.write(test::test_directory() / "altered.lcm")).value();
    }
    static std::vector<channel_event_t> ramps() {
        std::vector<channel_event_t> found;
        test::AlteredLog(path()).change<channel_event_t>("_X_CHANNELS", [&](channel_event_t& event) {
            if (event.kind == "analog" && event.detail != 0) { found.push_back(event); }
            return false;
        });
        return found;
    }
};

TEST_F(RecordedOutputs, OfHeldAndStoppedJobsAreExact) {
    record();
    const Findings findings = verify_log(path()).value();
    EXPECT_TRUE(findings.is_exact()) << to_text(findings);
    EXPECT_GT(findings.outputs, 30);
    EXPECT_EQ(to_report(findings).outputs_compared(), findings.outputs);
}

TEST_F(RecordedOutputs, AtAnotherTickOrWithAnotherValueOrSlopeAreFound) {
    record();
    const auto found = ramps();
    ASSERT_GT(found.size(), 5u);
    const std::int64_t sequence = found[2].sequence;
    EXPECT_EQ(altered(sequence, [](auto& event) { ++event.tick; }).verdict(), Verdict::NotExact);
    EXPECT_EQ(altered(sequence, [](auto& event) { --event.value; }).verdict(), Verdict::NotExact);
    EXPECT_EQ(altered(sequence, [](auto& event) { event.detail += 1; }).verdict(), Verdict::NotExact);
    EXPECT_EQ(altered(sequence, [](auto& event) { event.channel = 1; }).verdict(), Verdict::NotExact);
}

/// A camera takes pictures along X, with a hold on the way.
class RecordedPulses : public RecordedOutputs {
protected:
    static void record_pulses() {
        MachineSetup machine = test::example("laser");
        machine.outputs.push_back(
            {.name = "camera", .motor = "X", .channel = 3, .use = OutputUse::Places, .number = 3, .pulse_us = 20});
        const std::vector<double> at = parked_mm(machine);
        test::RecordedMachine recorded(machine, path());
        recorded.home();
        recorded.begin({.name = "pictures.gcode",
                        .axes = {"X", "Y"},
                        .start_mm = at,
                        .blocks = {event(EventKind::PulseSpacing, 3, 0.5), event(EventKind::PulsePlaces, 41, at[0] + 5),
                                   move(at[0] + 30, at[1] + 10), event(EventKind::PulseSpacing, 3, -1),
                                   event(EventKind::PulsePlaces, 50, at[0] + 20), move(at[0], at[1])}});
        recorded.advance_ms(400);
        recorded.command(CommandKind::Hold);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Holding));
        recorded.command(CommandKind::Resume);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        recorded.advance_ms(500);
    }
    static std::vector<channel_event_t> notes() {
        std::vector<channel_event_t> found;
        test::AlteredLog(path()).change<channel_event_t>("_X_CHANNELS", [&](channel_event_t& event) {
            if (event.kind.starts_with("compare")) { found.push_back(event); }
            return false;
        });
        return found;
    }
};

TEST_F(RecordedPulses, AreThoseOfTheStepsAcrossAHold) {
    record_pulses();
    const Findings findings = verify_log(path()).value();
    EXPECT_TRUE(findings.is_exact()) << to_text(findings);
    const std::vector<channel_event_t> all = notes();
    ASSERT_EQ(all.size(), 6U);
    EXPECT_EQ(all[0].detail, 41);
    EXPECT_EQ(all[1].detail, all[2].detail) << "those left at the hold are made behind it";
    EXPECT_LT(all[1].detail, 41);
    EXPECT_EQ(all[3].detail, 0);
    EXPECT_EQ(all[4].detail, 50);
    EXPECT_EQ(all[5].detail, 50 - 21) << "from 20 mm down to the end at 0";
}

TEST_F(RecordedPulses, ThatAreMissingOrAtAnotherTickAreFound) {
    record_pulses();
    const std::vector<channel_event_t> all = notes();
    ASSERT_EQ(all.size(), 6U);
    for (const std::size_t k : {1U, 3U}) {
        EXPECT_EQ(altered(all[k].sequence, [](auto& event) { ++event.detail; }).verdict(), Verdict::NotExact);
        EXPECT_EQ(altered(all[k].sequence, [](auto& event) { ++event.tick; }).verdict(), Verdict::NotExact);
    }
    EXPECT_EQ(altered(all[2].sequence, [](auto& event) { --event.detail; }).verdict(), Verdict::NotExact);
}

}  // namespace
}  // namespace lockstep::verification
