// The example of a workpiece: programs measure what the simulated machine's workpiece is.
#include <gtest/gtest.h>

#include <cmath>

#include "clients/planning/plan_summary.hpp"
#include "clients/simulation/simulate.hpp"
#include "services/documents/machine_file.hpp"
#include "services/documents/program_file.hpp"
#include "services/record/sinks.hpp"

namespace lockstep {
namespace {

TEST(MeasureExample, FindsTheCornerTheTopTheBoreAndTheBoss) {
    const auto machine = load_machine_file("deploy/examples/measure.textproto");
    ASSERT_TRUE(machine) << machine.error().front().message;
    const WorkBlock& block = machine->workpiece->blocks[0];
    const WorkBore& bore = block.bores[0];
    const WorkPost& boss = machine->workpiece->posts[0];
    GcodeSetup setup = program_setup("deploy/examples/measure.gcode", *machine, parked_mm(*machine));
    setup.awaits_touches = true;
    ProgramText text(LineReader::open("deploy/examples/measure.gcode").value(), setup);
    NoSink sink;
    const auto result = simulate(*machine, text, sink);
    ASSERT_TRUE(result);
    ASSERT_EQ(result->outcome, JobOutcome::Done) << result->trouble;
    // A step by which the axes and the workpiece may differ, and a step by which touches are rounded.
    const double within_mm = 2 / machine->axes[0].steps_per_mm;
    EXPECT_NEAR(text.global("_corner_x").value(), block.x_min_mm, within_mm);
    EXPECT_NEAR(text.global("_corner_y").value(), block.y_min_mm, within_mm);
    // Behind measure_corner the program's coordinates are those of G54, whose zero is the corner.
    EXPECT_NEAR(text.global("_centre_x").value(), boss.x_mm - block.x_min_mm, 2 * within_mm);
    EXPECT_NEAR(text.global("_centre_y").value(), boss.y_mm - block.y_min_mm, 2 * within_mm);
    EXPECT_NEAR(text.global("_diameter_x").value(), boss.diameter_mm, within_mm);
    EXPECT_NEAR(text.global("_diameter_y").value(), boss.diameter_mm, within_mm);
    // Of the bore, by its last four exact touches; those of the boss are behind them.
    const auto& touches = result->touches;
    ASSERT_EQ(touches.size(), 4 + 1 + 16 + 16);
    const auto place = [&](std::size_t touch, std::size_t axis) { return touches[touch].places_mm[axis]; };
    EXPECT_NEAR(place(4, 2), block.top_mm, within_mm);
    EXPECT_NEAR((place(14, 0) + place(16, 0)) / 2, bore.x_mm, within_mm);
    EXPECT_NEAR((place(18, 1) + place(20, 1)) / 2, bore.y_mm, within_mm);
    EXPECT_NEAR(place(20, 1) - place(18, 1) + machine->workpiece->tip_mm, bore.diameter_mm, within_mm);
}

}  // namespace
}  // namespace lockstep
