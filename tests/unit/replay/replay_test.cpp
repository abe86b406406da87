// A replay of each device's recorded input makes the recorded steps again, also through interruptions. It reports
// differences.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iterator>
#include <random>

#include "clients/replay/device_replay.hpp"
#include "clients/replay/replay.hpp"
#include "clients/verification/verification.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::replay {
namespace {

using test::RecordedMachine;
using testing::HasSubstr;
using testing::Not;

constexpr std::string_view kSquare = "G21 G90 F6000\nG1 X60 Y8\nX62 Y50\nG4 P0.2\nG0 X10 Y40\nX5 Y5\n";

class Replay : public testing::Test {
protected:
    std::filesystem::path log() const { return test::test_directory() / "run.lcm"; }
    std::filesystem::path made() const { return test::test_directory() / "made.lcm"; }

    void record(const std::function<void(RecordedMachine&)>& drive) const {
        RecordedMachine recorded(options(), log());
        recorded.home();
        drive(recorded);
    }
    VirtualOptions options() const {
        VirtualOptions result{.machine = machine, .config_hash = config_hash(machine), .start = Tick{20'000'000}};
        result.clocks = clocks;
        return result;
    }
    /// The replay makes the recorded steps, and its own log verifies like the recorded one.
    void expect_exact() const {
        LogSink sink(LogWriter::open(made()).value());
        const auto findings = replay_log(log(), &sink);
        ASSERT_TRUE(findings) << findings.error();
        ASSERT_TRUE(sink.finish());
        EXPECT_FALSE(findings->difference) << replay::to_text(*findings);
        EXPECT_THAT(replay::to_text(*findings), Not(HasSubstr("skipped")));
        const auto recorded = verification::verify_log(log());
        const auto again = verification::verify_log(made());
        ASSERT_TRUE(again) << again.error();
        EXPECT_FALSE(again->difference) << verification::to_text(*again);
        EXPECT_EQ(again->steps, recorded->steps);
        EXPECT_EQ(findings->steps, recorded->steps);
        EXPECT_GT(findings->steps, 1000);
    }

    MachineSetup machine = test::example("two-axis");
    std::vector<AxisClocks> clocks;
};

TEST_F(Replay, AProgramHeldResumedAndRunToItsEnd) {
    record([&](RecordedMachine& recorded) {
        recorded.begin(test::program_of(machine, kSquare));
        recorded.advance_ms(350);
        recorded.command(CommandKind::Hold);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Holding));
        recorded.command(CommandKind::Resume);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
    });
    expect_exact();
}

TEST_F(Replay, AnEmergencyStopAndTheHomingAfterIt) {
    record([&](RecordedMachine& recorded) {
        recorded.begin(test::program_of(machine, kSquare));
        recorded.advance_ms(800);
        recorded.command(CommandKind::EmergencyStop);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Fault));
        recorded.command(CommandKind::Reset);
        recorded.home();
    });
    expect_exact();
}

TEST_F(Replay, BoardsWithClocksOfTheirOwnByTheirOwnClocks) {
    machine.timing.time_source = TimeSource::Network;
    clocks = {{.process = {.offset = {5'000'000}, .ppm = 90}, .device = {.offset = {9'000'000}, .ppm = -70}},
              {.process = {.offset = {-4'000'000}, .ppm = -60}, .device = {.offset = {123}, .ppm = 100}}};
    record([&](RecordedMachine& recorded) {
        recorded.begin(test::program_of(machine, kSquare));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        recorded.begin_own(test::program_of(machine, "G0 X40 Y10\n"));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
    });
    expect_exact();
}

class ARecordedRun : public Replay {
protected:
    void SetUp() override {
        record([&](RecordedMachine& recorded) {
            recorded.begin(test::program_of(machine, kSquare));
            ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        });
    }
    Findings replay(const test::AlteredLog& altered) const {
        return replay_log(altered.write(test::test_directory() / "altered.lcm"), nullptr).value();
    }
};

TEST_F(ARecordedRun, AFrameThatDoesNotJoinIsRefusedByTheDeviceThoughItsStepsAreTheSame) {
    test::AlteredLog altered(log());
    ASSERT_EQ(altered.change<run_t>("_X_RUN",
                                    [](run_t& run) {
                                        const bool wanted = run.epoch != 0 && run.frame == 4;
                                        run.start_phase += wanted ? 1 : 0;
                                        return wanted;
                                    }),
              1);
    const Findings findings = replay(altered);
    ASSERT_TRUE(findings.difference);
    EXPECT_EQ(findings.difference->axis, "X");
    EXPECT_THAT(replay::to_text(findings), HasSubstr("not exact: axis X: the device"));
}

TEST_F(ARecordedRun, AStepThatWasMovedIsFound) {
    test::AlteredLog altered(log());
    int batches = 0;
    ASSERT_EQ(altered.change<step_batch_t>("_Y_STEPS",
                                           [&](step_batch_t& batch) {
                                               const bool wanted = ++batches == 40;
                                               batch.first_tick += wanted ? 1 : 0;
                                               return wanted;
                                           }),
              1);
    const Findings findings = replay(altered);
    ASSERT_TRUE(findings.difference);
    ASSERT_TRUE(findings.difference->tick_expected && findings.difference->tick_seen);
    EXPECT_EQ(findings.difference->tick_seen->value, findings.difference->tick_expected->value + 1);
}

TEST_F(ARecordedRun, WithoutItsPlanIsReplayedAllTheSame) {
    test::AlteredLog altered(log());
    EXPECT_GT(altered.leave_out<job_t>("_JOB", [](const job_t&) { return true; }), 0U);
    EXPECT_FALSE(replay(altered).difference);
}

TEST_F(ARecordedRun, WithoutItsFirstFramesIsReportedAsIncomplete) {
    test::AlteredLog altered(log());
    altered.leave_out<run_t>("_X_RUN", [](const run_t& run) { return run.sequence < 3; });
    const Findings findings = replay(altered);
    EXPECT_EQ(findings.verdict(), verification::Verdict::Unknown);
    EXPECT_THAT(replay::to_text(findings), HasSubstr("the record of runs 0 to 2 are not in the log"));
}

/// Numbers are damaged in messages that still decode. The replay may have any result, but it must end.
TEST_F(ARecordedRun, WithAnyDamagedNumbersIsReplayedToItsEnd) {
    const test::AlteredLog whole(log());
    std::mt19937_64 random(11);
    for (int round = 0; round < 100; ++round) {
        test::AlteredLog altered = whole;
        altered.change<run_t>("_RUN", [&](run_t& run) {
            if (random() % 20 != 0 || run.pieces == 0) { return false; }
            const std::size_t piece = random() % run.ticks.size();
            std::int64_t* const numbers[] = {&run.start_tick,   &run.start_count,     &run.start_phase,
                                             &run.stop_count,   &run.zero_count,      &run.sequence,
                                             &run.frame,        &run.incarnation,     &run.epoch,
                                             &run.ticks[piece], &run.velocity[piece], &run.acceleration[piece]};
            *numbers[random() % std::size(numbers)] ^= std::int64_t{1} << random() % 64;
            run.cut = static_cast<std::int8_t>(random() % 2);
            return true;
        });
        const auto findings = replay_log(altered.write(test::test_directory() / "altered.lcm"), nullptr);
        ASSERT_TRUE(findings || !findings.error().empty());
        ASSERT_TRUE(!findings || !findings->difference || !findings->difference->text.empty()) << "round " << round;
    }
}

TEST(ADevice, CannotBePoweredUpInMotionSoThatMotionIsSkipped) {
    Findings findings;
    int made = 0;
    DeviceReplay device("X", findings, [&](const MadeStep&) { ++made; });
    const analysis::Run moving{.incarnation = 7, .epoch = 5, .frame = 4, .start = Tick{1000}, .from = {kOneStep / 3}};
    device.on_run(moving);
    device.on_step({Tick{1010}, 1}, Tick{1010}, true);
    device.on_run_over();
    device.on_end();
    EXPECT_FALSE(findings.difference);
    EXPECT_EQ(findings.runs, 0);
    EXPECT_EQ(made, 0);
    ASSERT_EQ(findings.notes.size(), 1U);
    EXPECT_THAT(findings.notes.front(), HasSubstr("axis X: frame 4 is skipped"));
}

TEST(ADevice, HasOneNoteForAllRunsThatAreSkipped) {
    Findings findings;
    DeviceReplay device("X", findings, [](const MadeStep&) {});
    for (FrameNumber frame = 4; frame < 300; ++frame) {
        device.on_run({.incarnation = 7, .epoch = 5, .frame = frame, .start = Tick{1000}, .from = {kOneStep / 3}});
        device.on_run_over();
    }
    device.on_end();
    ASSERT_EQ(findings.notes.size(), 1U);
    EXPECT_THAT(findings.notes.front(), HasSubstr("axis X: frame 4 and 295 runs after it are skipped"));
}

}  // namespace
}  // namespace lockstep::replay
