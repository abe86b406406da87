#include "services/wire/dds/cut_text.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

TEST(CutText, KeepsWhatFits) { EXPECT_EQ(cut_text("X is at 12.345 mm", 17), "X is at 12.345 mm"); }

TEST(CutText, EndsBetweenTwoWords) {
    EXPECT_EQ(cut_text("X is at 12.345 mm", 16), "X is at ...");
    EXPECT_EQ(cut_text("X is at 12.345 mm", 12), "X is at ...");
}

TEST(CutText, CutsNoUtf8Character) {
    for (std::size_t most = 5; most < 12; ++most) {
        const std::string cut = cut_text("\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4", most);
        EXPECT_LE(cut.size(), most);
        EXPECT_EQ((cut.size() - 4) % 2, 0U) << cut;
    }
}

}  // namespace
}  // namespace lockstep
