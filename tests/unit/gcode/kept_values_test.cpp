// Offsets and tools outlive a program: the next program begins with those that the last one left.
#include <gtest/gtest.h>

#include "tests/unit/gcode/three_axes.hpp"

namespace lockstep {
namespace {

/// Reads one program after the other. Each begins with the machine at 0 and with the values that the previous one left.
GcodeReading read_in_turn(std::initializer_list<const char*> texts) {
    GcodeReading reading;
    GcodeSetup setup = three_axes();
    for (const char* text : texts) {
        setup.values = reading.values;
        auto read = read_gcode(text, setup);
        EXPECT_TRUE(read) << text << ": " << read.error().front().message;
        if (read) { reading = *std::move(read); }
    }
    return reading;
}

std::vector<double> last_target(const GcodeReading& reading) {
    std::vector<double> target;
    for (const Block& block : reading.program.blocks) {
        if (const auto* move = std::get_if<ProgramMove>(&block.action)) { target = move->target_mm; }
    }
    return target;
}

TEST(KeptValues, CoordinateSystemsAndRotationsLast) {
    const auto reading = read_in_turn({"G10 L2 P2 X10 Y20 R90\nM2\n", "G55 G0 X5 Y0\nM2\n"});
    const auto target = last_target(reading);
    EXPECT_NEAR(target[0], 10, 1e-9);
    EXPECT_NEAR(target[1], 25, 1e-9);
}

TEST(KeptValues, OffsetsOfG92Last) {
    EXPECT_EQ(last_target(read_in_turn({"G92 X-30\nM2\n", "G0 X0\nM2\n"})), (std::vector<double>{30, 0, 0}));
}

TEST(KeptValues, G92Point2LeavesThemForG92Point3OfTheNextProgram) {
    EXPECT_EQ(last_target(read_in_turn({"G92 X-30\nG92.2\n", "G92.3\nG0 X1\n"})), (std::vector<double>{31, 0, 0}));
}

TEST(KeptValues, OffsetsOfZeroAreTheSameAsNone) {
    EXPECT_EQ(read_in_turn({"G52 X5\nG52 X0\nM2\n"}).values, gcode::KeptValues{});
}

TEST(KeptValues, PlacesOfG28AndG30LastAndAreElseTheParkPosition) {
    EXPECT_EQ(last_target(read_in_turn({"G0 X7 Y8\nG28.1\nM2\n", "G28 X0\nM2\n"})), (std::vector<double>{7, 0, 0}));
    EXPECT_EQ(last_target(read_in_turn({"G0 X7 Y8\nG28.1\nM2\n", "G30 X0\nM2\n"})), (std::vector<double>{5, 0, 0}));
}

TEST(KeptValues, TheToolTableIsAnInputAndAnOutput) {
    GcodeSetup setup = three_axes();
    setup.values.tools[3] = {.pocket = 3, .offset = {0, 0, 10}, .diameter = 6};
    const auto read = read_gcode("G10 L1 P3 Z12 R2\nG43 H3\nG0 Z4\nM2\n", setup);
    ASSERT_TRUE(read) << read.error().front().message;
    EXPECT_EQ(last_target(*read)[2], 16);
    EXPECT_EQ(read->values.tools.at(3).offset[2], 12);
    EXPECT_EQ(read->values.tools.at(3).diameter, 4);
    EXPECT_EQ(read->values.tools.at(3).pocket, 3);
}

TEST(KeptValues, TheSystemInUseDoesNotLast) {
    EXPECT_EQ(last_target(read_in_turn({"G10 L2 P2 X50\nG55\n", "G0 X1\n"})), (std::vector<double>{1, 0, 0}));
}

TEST(KeptValues, AProgramThatSetsNothingLeavesThemAsTheyWere) {
    GcodeSetup setup = three_axes();
    setup.values.systems[8] = {.origin = {1, 2, 3}, .rotation = 4};
    setup.values.g92 = {5, 6};
    setup.values.home = gcode::Point{7};
    setup.values.tools[200] = {.offset = {8}, .orientation = 9};
    const auto read = read_gcode("G0 X20 Y20\nG91 G1 X1 F100\nM2\n", setup);
    ASSERT_TRUE(read) << read.error().front().message;
    EXPECT_EQ(read->values, setup.values);
}

}  // namespace
}  // namespace lockstep
