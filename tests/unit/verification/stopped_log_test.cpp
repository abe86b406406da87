// The last step marks when pulses ceased. The end of the frame that was cut does not.
#include <gtest/gtest.h>

#include "clients/analysis/analysis.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::analysis {
namespace {

TEST(StoppedLog, HasTheEmergencyStopAtEachAxissLastStep) {
    const MachineSetup machine = test::example("two-axis");
    const auto path = test::test_directory() / "run.lcm";
    {
        test::RecordedMachine recorded(machine, path);
        recorded.home();
        recorded.begin(test::program_of(machine, "G21 G90 F3000\nG1 X80 Y90\n"));
        recorded.advance_ms(1130);
        recorded.command(CommandKind::EmergencyStop);
        recorded.advance_ms(1000);
    }
    const Analysis found = analyze_log(path).value();
    int stopped = 0;
    for (const Event& event : found.happened) {
        if (event.what.find("pulses stopped at once") == event.what.npos) { continue; }
        for (const auto& axis : found.axes) {
            if (axis->name() == event.axis) { EXPECT_EQ(event.at, axis->statistics().last()->tick) << event.axis; }
        }
        ++stopped;
    }
    EXPECT_EQ(stopped, 2);
}

}  // namespace
}  // namespace lockstep::analysis
