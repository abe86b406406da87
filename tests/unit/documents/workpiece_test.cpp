// The simulated workpiece of a machine's file: what is read, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/documents/machine_file.hpp"
#include "tests/unit/documents/machine_text_examples.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

std::string axis_named(const std::string& name) {
    std::string text(kShortest.substr(kShortest.find("axis")));
    return text.replace(text.find("\"X\""), 3, '"' + name + '"');
}

std::string file_with(const std::string& workpiece) {
    return std::string(kShortest) + axis_named("Y") + axis_named("Z") +
           "input { name: \"tip\" motor: \"Z\" channel: 3 use: PROBE }\nworkpiece { " + workpiece + " }\n";
}

const std::string kBlock = "block { x_min_mm: 1 x_max_mm: 2 y_min_mm: 3 y_max_mm: 4 top_mm: 5 ";

std::string workpiece_error(const std::string& text) {
    const auto machine = parse_machine(text);
    return machine ? "" : to_text("m", machine.error());
}

TEST(WorkpieceInAFile, IsReadAndWrittenWithAllItsKeys) {
    const auto machine = parse_machine(
        file_with("tip_mm: 2 tip_length_mm: 7 " + kBlock +
                  "rise_x: 0.1 rise_y: -0.2 wave_mm: 0.3 wave_length_mm: 40 angle_deg: 3 bore { x_mm: 1.5 y_mm: 3.5 "
                  "diameter_mm: 0.5 } } post { x_mm: 9 y_mm: 8 diameter_mm: 7 top_mm: 6 }"));
    ASSERT_TRUE(machine) << to_text("m", machine.error());
    const WorkpieceConfig expected{.tip_mm = 2,
                                   .tip_length_mm = 7,
                                   .blocks = {{.x_min_mm = 1,
                                               .x_max_mm = 2,
                                               .y_min_mm = 3,
                                               .y_max_mm = 4,
                                               .top_mm = 5,
                                               .rise_x = 0.1,
                                               .rise_y = -0.2,
                                               .wave_mm = 0.3,
                                               .wave_length_mm = 40,
                                               .bores = {{1.5, 3.5, 0.5}},
                                               .angle_deg = 3}},
                                   .posts = {{.x_mm = 9, .y_mm = 8, .diameter_mm = 7, .top_mm = 6}}};
    EXPECT_EQ(machine->workpiece, expected);
    EXPECT_EQ(parse_machine(machine_text(*machine))->workpiece, expected);
}

TEST(WorkpieceInAFile, NeedsXYAndZAndTheProbesThatItCloses) {
    EXPECT_THAT(workpiece_error(std::string(kShortest) + "workpiece { }\n"), HasSubstr("the machine has no axis Y"));
    EXPECT_THAT(workpiece_error(file_with(kBlock + "probe: 1 }")),
                HasSubstr("workpiece.block[0].probe is 1, but no input"));
    EXPECT_THAT(workpiece_error(file_with("post { x_mm: 1 y_mm: 1 diameter_mm: 1 top_mm: 1 probe: 2 }")),
                HasSubstr("workpiece.post[0].probe is 2"));
}

TEST(WorkpieceInAFile, WithImpossiblePlacesIsRefused) {
    EXPECT_THAT(workpiece_error(file_with("block { x_min_mm: 1 }")),
                HasSubstr("workpiece.block[0].x_max_mm is missing"));
    EXPECT_THAT(workpiece_error(file_with("block { x_min_mm: 1 x_max_mm: 1 y_min_mm: 3 y_max_mm: 4 top_mm: 5 }")),
                HasSubstr("x_max_mm is 1; it must be above x_min_mm, 1"));
    EXPECT_THAT(workpiece_error(file_with(kBlock + "wave_mm: 6 }")), HasSubstr("at most a 20th of wave_length_mm, 5"));
    EXPECT_THAT(workpiece_error(file_with(kBlock + "bore { x_mm: 1 y_mm: 1 diameter_mm: 0 } }")),
                HasSubstr("workpiece.block[0].bore[0].diameter_mm is 0; it must be from 0.001"));
}

}  // namespace
}  // namespace lockstep
