// Each motor is checked by the clock of its own device.
#include "clients/verification/steps/clock_check.hpp"

#include <gtest/gtest.h>

#include "core/device/device_name.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

TEST(ClockCheck, AllowsTimesOfItsOwnClockToTheMotorWhoseDeviceHasOne) {
    MachineSetup machine = test::example("gantry");
    machine.axes.at(1).motors.at(0).device = read_device_name("uio:/dev/uio0").value();
    ClockCheck check;
    check.set_machine(machine);
    const analysis::StepBatch batch{.ahead_first = Ticks{5000}, .ahead_last = Ticks{5000}, .clock_error = Ticks{10}};
    EXPECT_EQ(check.take("Y1", batch), std::nullopt);
    EXPECT_NE(check.take("Y2", batch), std::nullopt) << "this one has the clock of its host";
}

}  // namespace
}  // namespace lockstep::verification
