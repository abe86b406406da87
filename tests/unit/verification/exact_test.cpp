// The machine's motion verifies, through holds, stops, pauses and faults.
#include <gtest/gtest.h>

#include <random>

#include "clients/verification/verification.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

using test::RecordedMachine;

constexpr std::string_view kSquare = "G21 G90 F6000\nG1 X60 Y8\nX62 Y50\nG4 P0.2\nG0 X10 Y40\nX5 Y5\n";

class Exact : public testing::Test {
protected:
    std::filesystem::path log() const { return test::test_directory() / "run.lcm"; }
    void expect_exact(std::int64_t jobs) const {
        const auto findings = verify_log(log());
        ASSERT_TRUE(findings.has_value()) << findings.error();
        EXPECT_FALSE(findings->difference.has_value()) << to_text(*findings);
        EXPECT_GT(findings->steps, 1000);
        EXPECT_EQ(findings->jobs, jobs);
    }

    MachineSetup machine = test::example("two-axis");
};

TEST_F(Exact, AProgramRunToItsEnd) {
    {
        RecordedMachine recorded(machine, log());
        recorded.home();
        recorded.begin(test::program_of(machine, kSquare));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
    }
    expect_exact(1);
}

/// Two boards: each device's run verifies, by its own clock.
VirtualOptions own_clocks(MachineSetup machine) {
    machine.timing.time_source = TimeSource::Network;
    const std::uint64_t hash = config_hash(machine);
    VirtualOptions options{.machine = std::move(machine), .config_hash = hash, .start = Tick{20'000'000}};
    options.clocks = {{.process = {.offset = {5'000'000}, .ppm = 90}, .device = {.offset = {9'000'000}, .ppm = -70}},
                      {.process = {.offset = {-4'000'000}, .ppm = -60}, .device = {.offset = {123}, .ppm = 100}}};
    return options;
}

TEST_F(Exact, BoardsWithClocksOfTheirOwn) {
    {
        RecordedMachine recorded(own_clocks(machine), log());
        recorded.home();
        recorded.begin(test::program_of(machine, kSquare));
        recorded.advance_ms(900);
        recorded.command(CommandKind::Hold);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Holding));
        recorded.command(CommandKind::Resume);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        recorded.begin_own(test::program_of(machine, "G0 X40 Y10\n"));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
    }
    expect_exact(1);
    const auto findings = verify_log(log());
    EXPECT_GT(findings->clock_error, Ticks{0});
    EXPECT_LE(findings->latest, findings->clock_error);
    ASSERT_FALSE(findings->notes.empty());
    EXPECT_NE(findings->notes.back().find("by its device's clock"), std::string::npos) << findings->notes.back();
}

TEST_F(Exact, OverridesTurnedAtAnyTimeWithAHoldAmongThem) {
    std::mt19937_64 random(1);
    const auto percent = [&] { return 10 + static_cast<int>(random() % 191); };
    {
        RecordedMachine recorded(machine, log());
        recorded.home();
        for (int job = 0; job < 5; ++job) {
            recorded.begin(test::program_of(machine, kSquare));
            for (int i = 0; i < 6; ++i) {
                recorded.advance_ms(static_cast<std::int64_t>(random() % 700));
                if (recorded.vm().state()->phase == MachinePhase::Idle) { break; }
                recorded.set_overrides({percent(), percent()});
                if (i != 3) { continue; }
                recorded.command(CommandKind::Hold);
                recorded.advance_ms(2000);
                recorded.set_overrides({percent(), percent()});
                recorded.command(CommandKind::Resume);
            }
            ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        }
    }
    expect_exact(5);
}

TEST_F(Exact, TwoProgramsOneAfterTheOther) {
    {
        RecordedMachine recorded(machine, log());
        recorded.home();
        for (int i = 0; i < 2; ++i) {
            recorded.begin(test::program_of(machine, kSquare));
            ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        }
    }
    expect_exact(2);
}

TEST_F(Exact, APauseBetweenTwoLegs) {
    {
        RecordedMachine recorded(machine, log());
        recorded.home();
        recorded.begin(test::program_of(machine, "G0 X40 Y10\nM0\nG0 X5 Y5\n"));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Paused));
        recorded.command(CommandKind::Resume);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
    }
    expect_exact(1);
}

class HeldAt : public Exact, public testing::WithParamInterface<int> {};

TEST_P(HeldAt, AndResumedTwice) {
    {
        RecordedMachine recorded(machine, log());
        recorded.home();
        recorded.begin(test::program_of(machine, kSquare));
        for (int i = 0; i < 2; ++i) {
            recorded.advance_ms(GetParam());
            recorded.command(CommandKind::Hold);
            ASSERT_TRUE(recorded.reaches(MachinePhase::Holding));
            recorded.command(CommandKind::Resume);
            ASSERT_TRUE(recorded.reaches(MachinePhase::Running));
        }
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
    }
    expect_exact(1);
}
INSTANTIATE_TEST_SUITE_P(Milliseconds, HeldAt, testing::Values(0, 150, 350, 600, 777, 1000));

TEST_F(Exact, StoppedInTheMiddle) {
    {
        RecordedMachine recorded(machine, log());
        recorded.home();
        recorded.begin(test::program_of(machine, kSquare));
        recorded.advance_ms(700);
        recorded.command(CommandKind::Stop);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
    }
    expect_exact(1);
}

TEST_F(Exact, AnEmergencyStopAndTheHomingAfterIt) {
    {
        RecordedMachine recorded(machine, log());
        recorded.home();
        recorded.begin(test::program_of(machine, kSquare));
        recorded.advance_ms(800);
        recorded.command(CommandKind::EmergencyStop);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Fault));
        recorded.command(CommandKind::Reset);
        recorded.home();
    }
    expect_exact(1);
}

class ByEachMethod : public Exact, public testing::WithParamInterface<StepMethod> {};

TEST_P(ByEachMethod, AxesOnTheirOwnToTheirEndAndStopped) {
    for (AxisConfig& axis : machine.axes) {
        axis.method = GetParam();
        if (GetParam() == StepMethod::Lai) { axis.max_velocity_mm_s = 40; }
        if (GetParam() == StepMethod::Lam) { axis.start_velocity_mm_s = axis.max_velocity_mm_s = 15; }
    }
    {
        RecordedMachine recorded(machine, log());
        recorded.home();
        recorded.begin_own(test::program_of(machine, "G0 X60 Y8\n"));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        recorded.begin_own(parse_gcode("G0 X5 Y50\n", gcode_setup(machine, {60, 8}, "back")).value());
        recorded.advance_ms(700);
        recorded.command(CommandKind::Stop);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
    }
    expect_exact(0);
}

INSTANTIATE_TEST_SUITE_P(All, ByEachMethod,
                         testing::Values(StepMethod::Ranade, StepMethod::Spielauer, StepMethod::Lai, StepMethod::Lam,
                                         StepMethod::Carrica));

TEST_F(Exact, SixAxesAtOnce) {
    machine = test::example("six-axis");
    {
        RecordedMachine recorded(machine, log());
        recorded.home();
        recorded.begin(test::program_of(machine, "G0 X30 Y20 Z50 A0 B10 C-90\nG0 X5 Y5 Z58 A-174 B-84 C-174\n"));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
    }
    expect_exact(1);
}

}  // namespace
}  // namespace lockstep::verification
