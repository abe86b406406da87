// The programs that measure with a probe: what they call, and what is refused before anything moves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/session/measuring/measure_words.hpp"
#include "clients/session/measuring/measuring_program.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

MachineSetup mill() {
    MachineSetup machine{{.name = "mill"}};
    for (const char* name : {"X", "Y", "Z"}) {
        machine.axes.push_back({.name = name, .steps_per_mm = 100, .position_min_mm = 0, .position_max_mm = 200});
    }
    machine.inputs = {{.name = "tip", .motor = "Z", .channel = 3, .use = InputUse::Probe, .number = 0}};
    return machine;
}

const std::vector<double> kTipAt{100, 60, 50};

MeasureOptions options_of(MeasureKind kind) {
    MeasureOptions options{.kind = kind, .feed_mm_min = 60, .back_mm = 1, .tip_mm = 2};
    options.diameter_mm = 20;
    options.down_mm = 10;
    options.clearance_mm = 5;
    options.along_mm = 30;
    options.spacing_mm = 20;
    if (kind == MeasureKind::Edge || kind == MeasureKind::Angle) { options.words = {"X=-15"}; }
    if (kind == MeasureKind::Corner) { options.words = {"X=15", "Y=-10"}; }
    if (kind == MeasureKind::Surface) { options.words = {"X=10:100", "Y=20:60"}; }
    return options;
}

std::string text_of_program(const MeasureOptions& options) {
    const auto program = measuring_program(mill(), kTipAt, options);
    EXPECT_TRUE(program) << text_of(program.error());
    return program ? program->text : "";
}

std::string error_of(const MeasureOptions& options, const std::vector<double>& start = kTipAt,
                     const MachineSetup& machine = mill()) {
    const auto program = measuring_program(machine, start, options);
    EXPECT_FALSE(program);
    return program ? "" : text_of(program.error());
}

TEST(MeasuringPrograms, CallTheirSubroutine) {
    EXPECT_THAT(text_of_program(options_of(MeasureKind::Edge)),
                HasSubstr("o<measure_edge> call [-15.000000] [0.000000] [2.000000] [60.000000] [1.000000] [0.000000]"));
    EXPECT_THAT(text_of_program(options_of(MeasureKind::Angle)), HasSubstr("o<measure_angle> call [-15.000000]"));
    EXPECT_THAT(text_of_program(options_of(MeasureKind::Corner)),
                HasSubstr("o<measure_corner> call [15.000000] [-10."));
    EXPECT_THAT(text_of_program(options_of(MeasureKind::Bore)), HasSubstr("o<measure_bore> call [20.000000] [2.0000"));
    EXPECT_THAT(text_of_program(options_of(MeasureKind::Boss)), HasSubstr("o<measure_boss> call [20.000000] [10.000"));
    EXPECT_THAT(text_of_program(options_of(MeasureKind::Tool)), HasSubstr("o<measure_tool> call [10.000000] [0.0000"));
}

TEST(MeasuringPrograms, DivideASurfaceEvenlyBySpacingAtMost) {
    const auto program = measuring_program(mill(), kTipAt, options_of(MeasureKind::Surface));
    ASSERT_TRUE(program) << text_of(program.error());
    EXPECT_THAT(program->grid->x_mm, ElementsAre(10, 28, 46, 64, 82, 100));
    EXPECT_THAT(program->grid->y_mm, ElementsAre(20, 40, 60));
    EXPECT_THAT(program->text, HasSubstr("G1 X10.000000 Y20.000000\no<measure_surface> call [18.000000] [6.000000]"));
}

TEST(MeasuringPrograms, ThatCouldLeaveTheTravelAreRefused) {
    MeasureOptions edge = options_of(MeasureKind::Edge);
    edge.words = {"X=-99.5"};
    EXPECT_THAT(error_of(edge), HasSubstr("the probe could go to X=-0.5"));
    EXPECT_THAT(error_of(options_of(MeasureKind::Bore), {100, 10, 50}), HasSubstr("outside the travel of axis Y"));
    EXPECT_THAT(error_of(options_of(MeasureKind::Boss), {100, 60, 5}), HasSubstr("Z=-5"));
    EXPECT_THAT(error_of(options_of(MeasureKind::Corner), {175, 60, 5}), HasSubstr("X=206"));
    EXPECT_THAT(error_of(options_of(MeasureKind::Angle), {100, 180, 5}), HasSubstr("Y=210"));
    MeasureOptions surface = options_of(MeasureKind::Surface);
    surface.words = {"X=10:210", "Y=20:60"};
    EXPECT_THAT(error_of(surface), HasSubstr("X=210"));
}

TEST(MeasuringPrograms, WithAWrongValueAreRefusedWithItsRange) {
    MeasureOptions options = options_of(MeasureKind::Bore);
    options.tip_mm = 20;
    EXPECT_THAT(error_of(options), HasSubstr("--tip is 20.000; it must be below the diameter, 20.000 mm"));
    options.feed_mm_min = 0;
    EXPECT_THAT(error_of(options), HasSubstr("--feed is 0; it must be from 0.01"));
    options = options_of(MeasureKind::Surface);
    options.spacing_mm = 0.1;
    EXPECT_THAT(error_of(options), HasSubstr("at most 10000 in all"));
}

TEST(MeasuringPrograms, NeedTheirAxesAndTheirProbe) {
    MachineSetup machine = mill();
    machine.axes[1].name = "V";
    EXPECT_THAT(error_of(options_of(MeasureKind::Bore), kTipAt, machine), HasSubstr("has no axis 'Y'"));
    machine = mill();
    machine.inputs.clear();
    EXPECT_THAT(error_of(options_of(MeasureKind::Bore), kTipAt, machine), HasSubstr("the machine has no probe"));
}

TEST(MeasureWords, AreWaysAndRangesOfXAndY) {
    EXPECT_EQ(one_way({"Y=-4.5"})->mm, -4.5);
    EXPECT_THAT(one_way({"X=1", "Y=1"}).error(), HasSubstr("write one"));
    EXPECT_THAT(one_way({"Z=1"}).error(), HasSubstr("only X and Y"));
    EXPECT_THAT(one_way({"X=0"}).error(), HasSubstr("no way"));
    EXPECT_THAT(both_ways({"X=1", "X=2"}).error(), HasSubstr("X=10 Y=8"));
    EXPECT_EQ((*both_ranges({"Y=5:7.5", "X=-1:1"}))[1].to_mm, 7.5);
    EXPECT_THAT(both_ranges({"X=10", "Y=1:2"}).error(), HasSubstr("'X=10' is not a range"));
    EXPECT_THAT(both_ranges({"X=10:5", "Y=1:2"}).error(), HasSubstr("smaller place first"));
}

TEST(Measurements, AreWrittenAsTextAndAsATable) {
    const MeasureOptions options = options_of(MeasureKind::Surface);
    const auto program = measuring_program(mill(), kTipAt, options);
    ASSERT_TRUE(program);
    std::vector<double> touches_z;
    for (int point = 0; point < 18; ++point) { touches_z.insert(touches_z.end(), {0, 1.0 + 0.25 * point}); }
    const auto global = [](std::string_view name) { return std::optional(name == "_lowest" ? 1 : 5.25); };
    const auto measured = measurement_of(options, *program, global, touches_z);
    ASSERT_TRUE(measured);
    EXPECT_EQ(text_of(*measured), "surface: 18 points, Z 1.0000 to 5.2500 mm");
    EXPECT_TRUE(
        csv_of(*measured).starts_with("x_mm,y_mm,z_mm\n10.000000,20.000000,1.000000\n28.000000,20.000000,1.25"));
    touches_z.pop_back();
    EXPECT_FALSE(measurement_of(options, *program, global, touches_z)) << "a touch is missing";
}

}  // namespace
}  // namespace lockstep
