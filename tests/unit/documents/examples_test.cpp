// The example machines and the example job are valid, and match their comments.
#include <gtest/gtest.h>

#include <cmath>

#include "services/documents/machine_file.hpp"
#include "services/documents/program_document.hpp"
#include "services/documents/program_file.hpp"

namespace lockstep {
namespace {

const std::filesystem::path kExamples = LOCKSTEP_EXAMPLES;

MachineSetup machine(const std::string& file) {
    auto loaded = load_machine_file(kExamples / file);
    if (loaded) { return *std::move(loaded); }
    ADD_FAILURE() << to_text(file, loaded.error());
    return {};
}

std::vector<double> parked(const MachineSetup& machine) {
    std::vector<double> places;
    for (const AxisConfig& axis : machine.axes) { places.push_back(axis.homing.park_mm); }
    return places;
}

Program plate() {
    const MachineSetup mill = machine("three-axis.textproto");
    auto program = load_gcode_file(kExamples / "plate.gcode", mill, parked(mill));
    if (program) { return *std::move(program); }
    ADD_FAILURE() << to_text("plate.gcode", program.error());
    return {};
}

TEST(Examples, MachinesHaveTheAxesOfTheirNames) {
    EXPECT_EQ(machine("two-axis.textproto").axes.size(), 2U);
    EXPECT_EQ(machine("three-axis.textproto").axes.size(), 3U);
    EXPECT_EQ(machine("three-containers.textproto").axes.size(), 3U);
    EXPECT_EQ(machine("six-axis.textproto").axes.size(), 6U);
}

TEST(Examples, HomingIsShort) {
    for (const auto* file :
         {"two-axis.textproto", "three-axis.textproto", "three-containers.textproto", "six-axis.textproto"}) {
        for (const AxisConfig& axis : machine(file).axes) {
            const HomingConfig& homing = axis.homing;
            const double search_mm = std::abs(axis.plant.start_position_mm - homing.switch_position_mm);
            const double park_mm = std::abs(homing.park_mm - homing.switch_position_mm);
            const double seconds = (search_mm + homing.pulloff_mm + park_mm) / homing.search_velocity_mm_s +
                                   homing.pulloff_mm / homing.latch_velocity_mm_s;
            EXPECT_LT(seconds, 5) << file << ", axis " << axis.name;
        }
    }
}

class ExampleProgram : public testing::TestWithParam<const char*> {};

TEST_P(ExampleProgram, BeginsAndEndsParked) {
    const MachineSetup mill = machine("three-axis.textproto");
    const auto file = read_program_file(kExamples / GetParam(), mill, parked(mill));
    ASSERT_TRUE(file) << to_text(GetParam(), file.error());
    EXPECT_TRUE(file->reading.notes.empty());
    const auto* end = std::get_if<ProgramMove>(&file->reading.program.blocks.back().action);
    ASSERT_NE(end, nullptr);
    EXPECT_EQ(end->target_mm, parked(mill));
}

TEST_P(ExampleProgram, CanBeRunAgainWithTheOffsetsThatItLeaves) {
    const MachineSetup mill = machine("three-axis.textproto");
    const auto first = read_program_file(kExamples / GetParam(), mill, parked(mill));
    ASSERT_TRUE(first) << to_text(GetParam(), first.error());
    const auto again = read_program_file(kExamples / GetParam(), mill, parked(mill), {}, first->reading.values);
    ASSERT_TRUE(again) << to_text(GetParam(), again.error());
    EXPECT_EQ(program_bytes(again->reading.program), program_bytes(first->reading.program));
    EXPECT_EQ(again->reading.values, first->reading.values);
}

INSTANTIATE_TEST_SUITE_P(Programs, ExampleProgram,
                         testing::Values("plate.gcode", "pocket.gcode", "drilling.gcode", "contour.gcode"));

TEST(Examples, ThePlateBeginsAndEndsParked) {
    const MachineSetup mill = machine("three-axis.textproto");
    const Program program = plate();
    EXPECT_EQ(program.name, "plate.gcode");
    EXPECT_EQ(program.start_mm, parked(mill));
    EXPECT_EQ(std::get<ProgramMove>(program.blocks.back().action).target_mm, parked(mill));
}

/// The time at feed alone, with rapids at the axes' top speed: a lower bound of the job's duration.
double least_seconds(const Program& program, const MachineSetup& machine) {
    double seconds = 0;
    std::vector<double> at = program.start_mm;
    for (const Block& block : program.blocks) {
        if (const auto* dwell = std::get_if<Dwell>(&block.action)) { seconds += dwell->seconds; }
        const auto* move = std::get_if<ProgramMove>(&block.action);
        if (move == nullptr) { continue; }
        double length = 0;
        double rapid = 0;
        for (std::size_t i = 0; i < at.size(); ++i) {
            length = std::hypot(length, move->target_mm[i] - at[i]);
            rapid = std::max(rapid, std::abs(move->target_mm[i] - at[i]) / machine.axes[i].max_velocity_mm_s);
        }
        seconds += move->rapid ? rapid : std::max(length / move->feed_mm_s, rapid);
        at = move->target_mm;
    }
    return seconds;
}

TEST(Examples, ThePlateTakesAboutHalfAMinute) {
    const double seconds = least_seconds(plate(), machine("three-axis.textproto"));
    EXPECT_GT(seconds, 20);
    EXPECT_LT(seconds, 35);
}

TEST(Examples, ThePlatePausesOnlyOnRequest) {
    const MachineSetup mill = machine("three-axis.textproto");
    const auto asked =
        load_gcode_file(kExamples / "plate.gcode", mill, parked(mill), {.pause_at_m1 = true, .skip_deletable = false});
    EXPECT_EQ(asked.value().blocks.size(), plate().blocks.size() + 1);
}

TEST(ProgramFile, ReportsTheFilesErrorsAndAStartThatDoesNotFit) {
    const MachineSetup plotter = machine("two-axis.textproto");
    const auto without_z = load_gcode_file(kExamples / "plate.gcode", plotter, parked(plotter));
    ASSERT_FALSE(without_z.has_value());
    EXPECT_EQ(without_z.error().front().line, 7);
    EXPECT_EQ(without_z.error().front().message, "Z22: this machine has no axis Z; its axes are X Y");
    EXPECT_FALSE(load_gcode_file(kExamples / "plate.gcode", plotter, {0, 0, 0}).has_value());
    EXPECT_FALSE(load_gcode_file(kExamples / "plate.gcode", plotter, {0, std::nan("")}).has_value());
    EXPECT_FALSE(load_gcode_file(kExamples, plotter, {0, 0}).has_value());
}

}  // namespace
}  // namespace lockstep
