// The programs of lockstep probe on a simulated machine: they measure what its workpiece truly is.
#include <gtest/gtest.h>

#include <cmath>

#include "clients/planning/plan_summary.hpp"
#include "clients/session/measuring/measuring_program.hpp"
#include "clients/simulation/simulate.hpp"
#include "core/number_text.hpp"
#include "services/documents/heights/height_file.hpp"
#include "services/documents/machine_file.hpp"
#include "services/documents/program_file.hpp"
#include "services/record/sinks.hpp"
#include "sim_fpga/contacts/workpiece.hpp"

namespace lockstep {
namespace {

class MeasuredWorkpiece : public testing::Test {
protected:
    MachineSetup machine = load_machine_file("deploy/examples/measure.textproto").value();
    // A step by which the axes and the workpiece may differ, and a step by which touches are rounded.
    double within_mm = 2 / machine.axes[0].steps_per_mm;

    /// Moves to the place, and measures there.
    std::optional<proto::Measurement> measure(const MeasureOptions& options, double x, double y, double z) {
        const auto program = measuring_program(machine, {x, y, z}, options);
        if (!program) {
            ADD_FAILURE() << text_of(program.error());
            return std::nullopt;
        }
        GcodeSetup setup = gcode_setup(machine, parked_mm(machine), "measure");
        setup.find_subroutine = subroutines_of(machine);
        setup.awaits_touches = true;
        const std::string way =
            "G21 G90\nG0 X" + number_text(x) + " Y" + number_text(y) + "\nG0 Z" + number_text(z) + "\n";
        ProgramText text(LineReader::of_text(way + program->text), setup);
        NoSink sink;
        const auto result = simulate(machine, text, sink);
        if (!result || result->outcome != JobOutcome::Done) {
            ADD_FAILURE() << (result ? result->trouble : result.error());
            return std::nullopt;
        }
        std::vector<double> touches_z;
        for (const ProbeTouch& touch : result->touches) { touches_z.push_back(touch.places_mm[2]); }
        return measurement_of(
            options, *program, [&](auto name) { return text.global(name); }, touches_z);
    }
    MeasureOptions with(MeasureKind kind, std::vector<std::string> words = {}) const {
        return {.kind = kind,
                .words = std::move(words),
                .feed_mm_min = 60,
                .tip_mm = machine.workpiece->tip_mm,
                .probe = 0};
    }
};

TEST_F(MeasuredWorkpiece, HasItsEdges) {
    const WorkBlock& block = machine.workpiece->blocks[0];
    const auto left = measure(with(MeasureKind::Edge, {"X=20"}), 50, 80, 25);
    ASSERT_TRUE(left);
    EXPECT_NEAR(left->x_mm(), block.x_min_mm, within_mm);
    const auto back = measure(with(MeasureKind::Edge, {"Y=-20"}), 100, 130, 25);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->y_mm(), block.y_max_mm, within_mm);
    EXPECT_FALSE(back->has_x_mm());
}

TEST_F(MeasuredWorkpiece, HasItsCorner) {
    MeasureOptions options = with(MeasureKind::Corner, {"X=10", "Y=10"});
    options.clearance_mm = 8;
    const auto corner = measure(options, 50, 30, 25);
    ASSERT_TRUE(corner);
    EXPECT_NEAR(corner->x_mm(), machine.workpiece->blocks[0].x_min_mm, within_mm);
    EXPECT_NEAR(corner->y_mm(), machine.workpiece->blocks[0].y_min_mm, within_mm);
}

TEST_F(MeasuredWorkpiece, HasItsBoreAndItsBoss) {
    const WorkBore& bore = machine.workpiece->blocks[0].bores[0];
    MeasureOptions options = with(MeasureKind::Bore);
    options.diameter_mm = 25;
    const auto in = measure(options, 92, 73, 25);
    ASSERT_TRUE(in);
    EXPECT_NEAR(in->x_mm(), bore.x_mm, within_mm);
    EXPECT_NEAR(in->y_mm(), bore.y_mm, within_mm);
    EXPECT_NEAR(in->diameter_x_mm(), bore.diameter_mm, within_mm);
    EXPECT_NEAR(in->diameter_y_mm(), bore.diameter_mm, within_mm);

    const WorkPost& boss = machine.workpiece->posts[0];
    options = with(MeasureKind::Boss);
    options.diameter_mm = 20;
    options.down_mm = 10;
    options.clearance_mm = 5;
    const auto on = measure(options, 168, 62, 35);
    ASSERT_TRUE(on);
    EXPECT_NEAR(on->x_mm(), boss.x_mm, within_mm);
    EXPECT_NEAR(on->y_mm(), boss.y_mm, within_mm);
    EXPECT_NEAR(on->diameter_x_mm(), boss.diameter_mm, within_mm);
    EXPECT_NEAR(on->diameter_y_mm(), boss.diameter_mm, within_mm);
}

TEST_F(MeasuredWorkpiece, HasTheAngleOfATurnedBlock) {
    machine.workpiece->blocks[0].angle_deg = 2.5;
    MeasureOptions options = with(MeasureKind::Angle, {"Y=20"});
    options.along_mm = 50;
    const auto along_x = measure(options, 80, 32, 25);
    ASSERT_TRUE(along_x);
    EXPECT_NEAR(along_x->angle_deg(), 2.5, 2 * within_mm / 50 * 57.3);
    options = with(MeasureKind::Angle, {"X=20"});
    options.along_mm = -50;
    const auto along_y = measure(options, 50, 110, 25);
    ASSERT_TRUE(along_y);
    EXPECT_NEAR(along_y->angle_deg(), 2.5, 2 * within_mm / 50 * 57.3);
}

TEST_F(MeasuredWorkpiece, ATouchOfTheSetterIsTheLengthOfTheTool) {
    machine.workpiece->tip_length_mm = 22.3;
    MeasureOptions options = with(MeasureKind::Tool);
    options.probe = 1;
    options.down_mm = 30;
    options.setter_mm = machine.workpiece->posts[1].top_mm;
    const auto tool = measure(options, 20, 150, 70);
    ASSERT_TRUE(tool);
    EXPECT_NEAR(tool->tool_length_mm(), 22.3, within_mm);
}

TEST_F(MeasuredWorkpiece, HasTheHeightsOfATiltedAndWavedTop) {
    WorkBlock& block = machine.workpiece->blocks[0];
    block.bores.clear();
    block.rise_x = 0.01;
    block.rise_y = -0.004;
    block.wave_mm = 0.3;
    MeasureOptions options = with(MeasureKind::Surface, {"X=70:130", "Y=50:110"});
    options.spacing_mm = 30;
    options.down_mm = 15;
    const auto surface = measure(options, 100, 80, 40);
    ASSERT_TRUE(surface);
    ASSERT_EQ(surface->points_size(), 9);
    // The ball touches beside its lowest point: radius times half the slope squared.
    const double slope = 0.01 + 0.3 * 2 * 3.1416 / block.wave_length_mm;
    for (const proto::SurfacePoint& point : surface->points()) {
        EXPECT_NEAR(point.z_mm(), Workpiece::top_mm(block, point.x_mm(), point.y_mm()), within_mm + slope * slope / 2)
            << point.x_mm() << " " << point.y_mm();
    }
}

/// A crooked plate is measured, and a program is bent by its heights.
class LevelledPlate : public MeasuredWorkpiece {
protected:
    static constexpr double kDepth_mm = 0.1;

    LevelledPlate() {
        WorkBlock& block = machine.workpiece->blocks[0];
        block.bores.clear();
        block.rise_x = 0.01;
        block.rise_y = -0.004;
        block.wave_mm = 0.1;
    }
    HeightMap measured_heights() {
        MeasureOptions options = with(MeasureKind::Surface, {"X=70:130", "Y=50:110"});
        options.spacing_mm = 10;
        options.down_mm = 12;
        const auto surface = measure(options, 100, 80, 40);
        first_z_mm_ = surface.value().points(0).z_mm();
        return parse_height_map(csv_of(*surface)).value();
    }
    /// Cuts a line, a circle and a line across the plate.
    GcodeReading engraving(const std::optional<HeightMap>& heights) {
        GcodeSetup setup = gcode_setup(machine, parked_mm(machine), "engraving");
        if (heights) { setup.switches.heights = std::make_shared<const HeightMap>(*heights); }
        const std::string depth = number_text(first_z_mm_ - kDepth_mm);
        return read_gcode("G21 G90\nG0 X72 Y52\nG1 Z" + depth + " F600\nX128 Y108\nX120 Y80\nG2 I-20 J0\nG1 X75 Y105\n",
                          setup)
            .value();
    }
    /// The greatest error of the depth of any cut.
    double error_mm(const Program& program) const {
        const WorkBlock& block = machine.workpiece->blocks[0];
        std::vector<double> from = program.start_mm;
        double greatest = 0;
        bool cuts = false;
        for (const Block& one : program.blocks) {
            const auto* move = std::get_if<ProgramMove>(&one.action);
            if (move == nullptr) { continue; }
            for (int i = 0; cuts && i <= 10; ++i) {
                const auto at = [&](std::size_t axis) {
                    return from[axis] + i * 0.1 * (move->target_mm[axis] - from[axis]);
                };
                greatest = std::max(greatest, std::abs(Workpiece::top_mm(block, at(0), at(1)) - at(2) - kDepth_mm));
            }
            cuts = cuts || !move->rapid;
            from = move->target_mm;
        }
        return greatest;
    }

private:
    double first_z_mm_ = 0;
};

TEST_F(LevelledPlate, IsCutToAnEvenDepth) {
    const HeightMap heights = measured_heights();
    const GcodeReading bent = engraving(heights);
    EXPECT_GT(error_mm(engraving(std::nullopt).program), 0.3) << "the plate is crooked";
    EXPECT_LT(error_mm(bent.program), 0.025) << "bilinear between points 10 mm apart, and the steps of the touches";
    NoSink sink;
    const auto run = simulate(machine, bent.program, sink);
    ASSERT_TRUE(run);
    EXPECT_EQ(run->outcome, JobOutcome::Done) << run->trouble;
}

}  // namespace
}  // namespace lockstep
