// The messages of an axis come late in the log, because its process stalled or the network delayed them. The axis is
// analysed like any other.
#include <gtest/gtest.h>

#include "clients/analysis/analysis.hpp"
#include "clients/analysis/report.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::analysis {
namespace {

using test::AlteredLog;
using test::RecordedMachine;

class LateMessages : public testing::Test {
protected:
    static constexpr std::int64_t kLate_us = 2'000'000;

    std::filesystem::path path() const { return test::test_directory() / "run.lcm"; }
    proto::AnalysisReport report_of(const std::filesystem::path& log) const {
        proto::AnalysisReport report = to_report(analyze_log(log).value());
        report.clear_log();
        return report;
    }
    /// The log with the messages of these channels two seconds later in it.
    std::filesystem::path with_late(std::string_view channels) const {
        AlteredLog log(path());
        for (AlteredLog::Event& event : log.events()) {
            if (event.channel.find(channels) != event.channel.npos) { event.utime += kLate_us; }
        }
        std::ranges::stable_sort(log.events(), {}, &AlteredLog::Event::utime);
        return log.write(test::test_directory() / "late.lcm");
    }
    void expect_same_though_late(std::string_view channels) const {
        const proto::AnalysisReport original = report_of(path());
        EXPECT_LT(original.largest_distance_mm(), 0.02);
        EXPECT_EQ(original.DebugString(), report_of(with_late(channels)).DebugString());
    }
    void record(const MachineSetup& machine) const {
        RecordedMachine recorded(machine, path());
        recorded.home();
        recorded.begin(test::program_of(machine, "G21 G90 F6000\nG1 X60 Y8\nX62 Y50\nG4 P0.3\nX10 Y40\nX5 Y5\n"));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        recorded.advance_ms(1000);
    }
};

TEST_F(LateMessages, AllOfAnAxis) {
    record(test::example("two-axis"));
    expect_same_though_late("_Y_");
}

TEST_F(LateMessages, OnlyTheStepsOfAnAxis) {
    record(test::example("two-axis"));
    expect_same_though_late("_Y_STEPS");
}

TEST_F(LateMessages, OfAProcessThatStallsInMotionAndContinues) {
    const MachineSetup machine = test::example("two-axis");
    {
        RecordedMachine recorded(machine, path());
        recorded.home();
        recorded.begin(test::program_of(machine, "G21 G90 F6000\nG1 X80 Y90\nX10 Y40\nX5 Y5\n"));
        recorded.advance_ms(820);
        recorded.vm().schedule(
            {.kind = VirtualFault::Kind::Freeze, .process = 1, .at = recorded.vm().now(), .lasts = Ticks{kLate_us}});
        recorded.advance_ms(8000);
    }
    const Analysis found = analyze_log(path()).value();
    EXPECT_LT(found.largest_distance_mm.value(), 0.02);
    EXPECT_EQ(found.jobs.back().moves_without_distance, 0);
}

}  // namespace
}  // namespace lockstep::analysis
