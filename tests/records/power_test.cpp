// The power at each place is that of the axes, whichever motors move them, for each analog output.
#include <gtest/gtest.h>

#include <filesystem>

#include "clients/analysis/analysis.hpp"
#include "clients/analysis/report.hpp"
#include "tests/records/machine_run.hpp"

namespace lockstep::records {
namespace {

/// With a laser that follows the speed, and a lamp that M67 sets.
MachineSetup with_lights(MachineSetup machine) {
    machine.outputs = {{.name = "laser",
                        .motor = "X",
                        .use = OutputUse::Spindle,
                        .pwm = PwmConfig{.hz = 5000, .full_scale = 1000, .follows_speed = true},
                        .stays_at_interruption = false},
                       {.name = "lamp", .motor = "Y", .number = 1, .pwm = PwmConfig{.hz = 5000, .full_scale = 100}}};
    return read_again(machine);
}

/// Two lines of 20 mm with the laser, the second one with the lamp too, in which the motion is held.
proto::AnalysisReport engraved(const MachineSetup& machine) {
    MachineRun run(with_lights(machine));
    run.home();
    run.begin("G21 G90\nG0 X8 Y8\nM4 S600 F1200\nG1 X28\nM67 E1 Q50\nG1 Y28\nM67 E1 Q0\nM5\nG0 X5 Y5\n");
    run.wait_ms(1500);
    run.hold();
    run.resume();
    run.to_rest();
    run.wait_ms(300);
    const auto log = record_folder() / "power.lcm";
    write_record(run.finish(), log);
    const auto report = analysis::to_report(analysis::analyze_log(log, {.curves = false}).value());
    std::filesystem::remove(log);
    return report;
}

class PowerOfARecord : public testing::TestWithParam<MachineSetup (*)()> {};

TEST_P(PowerOfARecord, IsWhereTheWordsAskForIt) {
    const auto report = engraved(GetParam()());
    ASSERT_EQ(report.power_size(), 2) << report.DebugString();
    const proto::PowerReport& laser = report.power(0);
    EXPECT_EQ(laser.output(), "laser");
    EXPECT_NEAR(laser.asked_mm(), 40, 0.01);
    EXPECT_NEAR(laser.made_mm(), 40, 0.1);
    EXPECT_NEAR(laser.asked_energy_s(), 0.6 * 40 / 20, 1e-6);
    EXPECT_NEAR(laser.made_energy_s(), laser.asked_energy_s(), 0.01 * laser.asked_energy_s())
        << "in proportion to the speed, also in the ramps and in the hold";
    EXPECT_NEAR(laser.most_energy_ms_per_mm(), 30, 1e-6);
    EXPECT_LT(laser.largest_energy_difference_percent(), 15) << "beside rests";
    EXPECT_EQ(laser.unknown_mm(), 0);
    const proto::PowerReport& lamp = report.power(1);
    EXPECT_EQ(lamp.output(), "lamp");
    EXPECT_NEAR(lamp.asked_mm(), 20, 0.01);
    EXPECT_NEAR(lamp.made_mm(), 20, 0.1);
    EXPECT_GT(lamp.changes_compared(), 0U);
    EXPECT_LT(lamp.largest_place_mm(), 0.04);
}

INSTANTIATE_TEST_SUITE_P(Machines, PowerOfARecord, testing::Values(small_plotter, small_core_xy, small_gantry));

}  // namespace
}  // namespace lockstep::records
