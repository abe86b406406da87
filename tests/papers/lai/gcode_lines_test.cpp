// C.-K. Lai, W.-N. Chien, Y.-T. Tsao, "An FPGA-Based Multiple-Axis Velocity Controller and Stepping Motors Drives
// Design", Fig. 13: the G-code of the six lines from (0,0) ... (5,0) to (5,5), simulated. The paper prints neither the
// program nor its scale; here a unit is 1 mm of 80 pulses, and the feed is four pulses per period, as in Section 3.1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/coordinator/path/lai_path.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/gcode/gcode.hpp"
#include "core/methods/lai_dda.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t kPulsesPerUnit = 80;

constexpr const char* kSixLines = R"(G21 G90 F461.5
G0 X0 Y0
G1 X5 Y5
G0 X1 Y0
G1 X5 Y5
G0 X2 Y0
G1 X5 Y5
G0 X3 Y0
G1 X5 Y5
G0 X4 Y0
G1 X5 Y5
G0 X5 Y0
G1 X5 Y5
M2
)";

MachineConfig plotter() {
    MachineConfig machine{.name = "plotter", .coordination = StepMethod::Lai};
    for (const char* name : {"X", "Y"}) {
        machine.axes.push_back({.name = name,
                                .steps_per_mm = kPulsesPerUnit,
                                .start_velocity_mm_s = 5,
                                .max_velocity_mm_s = 50,
                                .max_accel_mm_s2 = 800,
                                .max_decel_mm_s2 = 800,
                                .position_min_mm = 0,
                                .position_max_mm = 10});
    }
    return machine;
}

/// The moves of the program. The first and every second one after it is a line.
std::vector<PathMove> moves_of(const MachineConfig& machine) {
    GcodeSetup setup{.program_name = "six lines"};
    for (const AxisConfig& axis : machine.axes) {
        setup.axes.push_back({.name = axis.name, .min_mm = axis.position_min_mm, .max_mm = axis.position_max_mm});
    }
    const auto read = read_gcode(kSixLines, setup);
    if (!read) {
        ADD_FAILURE() << read.error().front().message;
        return {};
    }
    const ProgramPlanner planner(machine);
    const auto legs = planner.plan(read->program, {0, 0});
    if (!legs) {
        ADD_FAILURE() << legs.error().text;
        return {};
    }
    return planner.moves_of(read->program, legs->front());
}

Path planned(const std::vector<PathMove>& moves, const MachineConfig& machine, LaiFollowing following) {
    std::vector<AxisLimits> limits;
    std::vector<double> scale;
    for (const AxisConfig& axis : machine.axes) {
        limits.push_back(limits_of(axis, machine.tick_ns));
        scale.push_back(axis.steps_per_mm);
    }
    return plan_lai_path(moves, {}, limits, scale, machine.tick_ns, least_move(machine), following);
}

/// The pulses of one line in each period.
std::vector<methods::PeriodPulses> periods_of(const Path& path, const PathMove& line) {
    std::vector<methods::PeriodPulses> periods;
    for (const PathMove& part : path.moves) {
        if (part.block == line.block) { periods.push_back({part.to[0] - part.from[0], part.to[1] - part.from[1]}); }
    }
    return periods;
}

/// The greatest distance from the straight line at the end of a period, in pulses of the short axis.
double farthest_at_a_periods_end(const std::vector<methods::PeriodPulses>& periods, methods::PeriodPulses end) {
    double farthest = 0;
    methods::PeriodPulses at;
    for (const methods::PeriodPulses& period : periods) {
        at = {at.x + period.x, at.y + period.y};
        const double on_line = static_cast<double>(at.y) * static_cast<double>(end.x) / static_cast<double>(end.y);
        farthest = std::max(farthest, std::abs(static_cast<double>(at.x) - on_line));
    }
    return farthest;
}

class LaiFigure13 : public testing::TestWithParam<LaiFollowing> {};

TEST_P(LaiFigure13, TheProgramsSixLinesEndAtFiveFiveWithAtMostFourPulsesAPeriod) {
    const MachineConfig machine = plotter();
    const auto moves = moves_of(machine);
    ASSERT_EQ(moves.size(), 11U);  // six lines, and the way back between them
    const Path path = planned(moves, machine, GetParam());
    for (std::size_t i = 0; i < moves.size(); i += 2) {
        EXPECT_EQ(moves[i].from, (AxisCounts{static_cast<std::int64_t>(i / 2) * kPulsesPerUnit, 0}));
        EXPECT_EQ(moves[i].to, (AxisCounts{5 * kPulsesPerUnit, 5 * kPulsesPerUnit}));
        const auto periods = periods_of(path, moves[i]);
        EXPECT_EQ(methods::total(periods), (methods::PeriodPulses{moves[i].to[0] - moves[i].from[0], moves[i].to[1]}));
        for (const methods::PeriodPulses& period : periods) {
            EXPECT_LE(period.x, 4);
            EXPECT_LE(period.y, 4);
        }
    }
}

TEST_P(LaiFigure13, TheirPulsesThroughTheDdaAreMonotone) {
    const MachineConfig machine = plotter();
    const auto moves = moves_of(machine);
    const Path path = planned(moves, machine, GetParam());
    for (std::size_t i = 0; i < moves.size(); i += 2) {
        const auto walk = methods::walk_two_axes(periods_of(path, moves[i]), methods::LaiPulses::Spread);
        for (std::size_t k = 1; k < walk.size(); ++k) {
            EXPECT_GE(walk[k].x, walk[k - 1].x);
            EXPECT_GE(walk[k].y, walk[k - 1].y);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Both, LaiFigure13, testing::Values(LaiFollowing::OnTheLine, LaiFollowing::AsPublished),
                         [](const auto& parameter) {
                             return parameter.param == LaiFollowing::OnTheLine ? "OnTheLine" : "AsPublished";
                         });

TEST(LaiCoordination, ProgramsKeepTheShortAxisWithinHalfAPulseWhereThePapersPlanFallsBehind) {
    const MachineConfig machine = plotter();
    const auto moves = moves_of(machine);
    const Path on_line = planned(moves, machine, LaiFollowing::OnTheLine);
    const Path published = planned(moves, machine, LaiFollowing::AsPublished);
    double farthest = 0;
    for (std::size_t i = 0; i < moves.size(); i += 2) {
        const methods::PeriodPulses end{moves[i].to[0] - moves[i].from[0], moves[i].to[1]};
        EXPECT_LE(farthest_at_a_periods_end(periods_of(on_line, moves[i]), end), 0.5) << i;
        const double behind = farthest_at_a_periods_end(periods_of(published, moves[i]), end);
        farthest = std::max(farthest, behind);
    }
    EXPECT_NEAR(farthest, 52, 0.5);  // of 320, on the line from (1,0): 3.2 pulses a period are rounded to 3
}

}  // namespace
}  // namespace lockstep
