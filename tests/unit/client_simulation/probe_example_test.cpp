// The example of a probe: the simulated slide touches a plate, and the program goes on with the place of the touch.
#include <gtest/gtest.h>

#include <cmath>

#include "clients/planning/plan_summary.hpp"
#include "clients/simulation/simulate.hpp"
#include "services/documents/machine_file.hpp"
#include "services/documents/program_file.hpp"
#include "services/record/sinks.hpp"

namespace lockstep {
namespace {

TEST(ProbeExample, SetsTheZeroOfTheWorkBelowItsPlate) {
    constexpr std::size_t kZ = 2;
    constexpr double kPlate_mm = 62.5;
    const auto loaded = load_machine_file("deploy/examples/probe.textproto");
    ASSERT_TRUE(loaded) << loaded.error().front().message;
    const MachineSetup& machine = *loaded;
    GcodeSetup setup = program_setup("deploy/examples/probe.gcode", machine, parked_mm(machine));
    setup.awaits_touches = true;
    ProgramText text(LineReader::open("deploy/examples/probe.gcode").value(), setup);
    NoSink sink;
    const auto result = simulate(machine, text, sink);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->outcome, JobOutcome::Done) << result->trouble;
    ASSERT_EQ(result->touches.size(), 2u);
    const double step_mm = 1 / machine.axes[kZ].steps_per_mm;
    for (const ProbeTouch& touch : result->touches) {
        EXPECT_TRUE(touch.touched);
        EXPECT_NEAR(touch.places_mm[kZ], kPlate_mm, step_mm);
        EXPECT_LT(touch.rest_mm[kZ], touch.places_mm[kZ]);
        EXPECT_GE(touch.rest_mm[kZ], touch.places_mm[kZ] - machine.inputs[0].max_overshoot_mm);
    }
    const double z_mm = static_cast<double>(result->final_counts[kZ]) * step_mm;
    EXPECT_NEAR(z_mm, kPlate_mm - 12 + 20, 2 * step_mm);
}

}  // namespace
}  // namespace lockstep
