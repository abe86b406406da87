// The rest of a program from a given line.
#include "core/program.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

Program square() {
    Program program{.name = "square", .axes = {"X", "Y"}, .start_mm = {5, 5}};
    program.blocks = {{2, ProgramMove{{20, 5}, 0, true}},
                      {3, ProgramMove{{20, 30}, 10, false}},
                      {5, Dwell{0.5}},
                      {6, ProgramMove{{5, 30}, 10, false}}};
    return program;
}

const ProgramMove& move(const Program& program, std::size_t block) {
    return std::get<ProgramMove>(program.blocks.at(block).action);
}

TEST(ProgramFrom, ALineGoesFirstToWhereItBegins) {
    const auto rest = program_from(square(), 3, {50, 50});
    ASSERT_TRUE(rest.has_value());
    EXPECT_EQ(rest->start_mm, (std::vector<double>{50, 50}));
    ASSERT_EQ(rest->blocks.size(), 4u);
    EXPECT_TRUE(move(*rest, 0).rapid);
    EXPECT_EQ(move(*rest, 0).target_mm, (std::vector<double>{20, 5}));
    EXPECT_EQ(move(*rest, 1).target_mm, (std::vector<double>{20, 30}));
}

TEST(ProgramFrom, ContinuesDirectlyIfTheMachineIsThere) {
    const auto rest = program_from(square(), 6, {20, 30});
    ASSERT_TRUE(rest.has_value());
    ASSERT_EQ(rest->blocks.size(), 1u);
    EXPECT_FALSE(move(*rest, 0).rapid);
}

TEST(ProgramFrom, ALineWithoutMotionMeansTheNextWithMotion) {
    const auto rest = program_from(square(), 4, {20, 30});
    ASSERT_TRUE(rest.has_value());
    EXPECT_EQ(rest->blocks.front().line, 5);
}

TEST(ProgramFrom, ALineAfterTheLastIsRefused) { EXPECT_EQ(program_from(square(), 7, {20, 30}).error(), 6); }

}  // namespace
}  // namespace lockstep
