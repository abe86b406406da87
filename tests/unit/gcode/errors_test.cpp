// The errors in a G-code text: their place and message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gcode/three_axes.hpp"

namespace lockstep {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::vector<GcodeError> errors(const std::string& text) {
    const auto program = parse_gcode(text, three_axes());
    return program ? std::vector<GcodeError>{} : program.error();
}

struct Refusal {
    std::string text;
    int line;
    int column;
    std::string message;
    friend void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.message; }
};

class GcodeRefused : public testing::TestWithParam<Refusal> {};

TEST_P(GcodeRefused, WithPlaceValueAndRemedy) {
    const Refusal& refusal = GetParam();
    const auto found = errors(refusal.text);
    ASSERT_EQ(found.size(), 1U) << refusal.text;
    EXPECT_EQ(found[0].line, refusal.line) << found[0].message;
    EXPECT_EQ(found[0].column, refusal.column) << found[0].message;
    EXPECT_THAT(found[0].message, HasSubstr(refusal.message));
}

INSTANTIATE_TEST_SUITE_P(
    Characters, GcodeRefused,
    testing::Values(Refusal{"G0 X1\nG0 X\xc3\xa9", 2, 5, "0xC3"}, Refusal{std::string("G0\0X1", 5), 1, 3, "0x00"},
                    Refusal{"G0 X1\n\xef\xbb\xbfG0 X1", 2, 1, "0xEF"},
                    Refusal{"G0 X1\nG0 X2 ; a\x1b[31m", 2, 10, "0x1B is a control byte"},
                    Refusal{"G0 (across X1", 1, 4, "not closed"}, Refusal{"G0 (a (b) ) X1", 1, 7, "inside a comment"},
                    Refusal{"G0 X1 )", 1, 7, "')'"}, Refusal{"G0 X1 / Y1", 1, 7, "'/'"}, Refusal{"% G0", 1, 3, "alone"},
                    Refusal{"G0 X1" + std::string(252, ' '), 1, 257, "257 characters, more than 256"}));

INSTANTIATE_TEST_SUITE_P(Numbers, GcodeRefused,
                         testing::Values(Refusal{"G0 X", 1, 4, "no number"}, Refusal{"G0 X Y1", 1, 4, "no number"},
                                         Refusal{"G0 X1.2.3", 1, 4, "'1.2.3'"}, Refusal{"G0 X.", 1, 4, "'.'"},
                                         Refusal{"G0 X1-", 1, 6, "'-'"}, Refusal{"G0 X1(c)0", 1, 9, "'0'"},
                                         Refusal{"G0 X1e2", 1, 6, "E2"}, Refusal{"G0 X2000000", 1, 4, "1000000"},
                                         Refusal{"G0 X1" + std::string(240, '0'), 1, 4, "out of range"}));

INSTANTIATE_TEST_SUITE_P(Words, GcodeRefused,
                         testing::Values(Refusal{"G6 X1 Y1", 1, 1, "G6 is not a code of this machine"},
                                         Refusal{"G0 X1\nM150", 2, 1, "M150"}, Refusal{"G1.05 X1 F1", 1, 1, "G1.05"},
                                         Refusal{"G-1", 1, 1, "G-1"}, Refusal{"$1000", 1, 1, "'$'"},
                                         Refusal{"G0 X1 A5", 1, 7, "no axis A; its axes are X Y Z"},
                                         Refusal{"G0 X1 X2", 1, 7, "X2 repeats X1"}, Refusal{"F1 F1", 1, 4, "repeats"},
                                         Refusal{"F9 G41.1 D1\nG1 X5\nG10 L20 P2 X1", 3, 1, "from the axes' positions"},
                                         Refusal{"F9 G2 X1 I0.5 P1 G4", 1, 18, "both use P"},
                                         Refusal{"F9 G2 X1 I0.5\nX2 I0.5 P1 G4", 2, 12, "both use P"},
                                         Refusal{"G0 N5 X1", 1, 4, "first"},
                                         Refusal{"N-1 G0 X1", 1, 1, "must be 0 or above"}));

INSTANTIATE_TEST_SUITE_P(Groups, GcodeRefused,
                         testing::Values(Refusal{"G0 G1 X1 F5", 1, 4, "G1 after G0"},
                                         Refusal{"G90 G91", 1, 5, "distance mode"}, Refusal{"G20 G21", 1, 5, "units"},
                                         Refusal{"G4 P1 G28", 1, 7, "non-modal"}, Refusal{"M0 M2", 1, 4, "stop"},
                                         Refusal{"G0 G28 X1", 1, 1, "both use"},
                                         Refusal{"G1 G92 X1", 1, 1, "both use"}));

INSTANTIATE_TEST_SUITE_P(Values, GcodeRefused,
                         testing::Values(Refusal{"G1 X1", 1, 1, "F, per minute"},
                                         Refusal{"G1 X1\nX2\nX3", 1, 1, "F, per minute"},
                                         Refusal{"G1 X1 F0", 1, 7, "above 0"}, Refusal{"G1 X1 F-5", 1, 7, "F-5"},
                                         Refusal{"G1 X1 F.001", 1, 7, "too slow"}, Refusal{"X1", 1, 1, "G0 or G1"},
                                         Refusal{"G4", 1, 1, "write P"}, Refusal{"G4 P-1", 1, 4, "0 to 86400 s"},
                                         Refusal{"G4 P90000", 1, 4, "86400"},
                                         Refusal{"G0 P1", 1, 4, "belongs to no code"},
                                         Refusal{"G92", 1, 1, "sets no axis"}));

INSTANTIATE_TEST_SUITE_P(
    Travel, GcodeRefused,
    testing::Values(Refusal{"G0 X10 Y200.5", 1, 8, "to 200.5 mm, which is outside its travel of 0 to 200 mm"},
                    Refusal{"G0 Z-.1", 1, 4, "position_min_mm"}, Refusal{"G0 Z61", 1, 4, "position_max_mm"},
                    Refusal{"G20 G0 X8", 1, 8, "203.2 mm"}, Refusal{"G0 X150\nG91 X60", 2, 5, "210 mm"},
                    Refusal{"G0 X50\nG92 X0\nG0 X160", 3, 4, "X160 takes X to 210 mm"},
                    Refusal{"G28 X300", 1, 5, "300 mm"}));

TEST(GcodeErrors, ReportsEveryWrongLineUpToALimit) {
    const auto some = errors("G0 X300\nG7\nG0 X10\nG0 Y-1 Z99\n");
    ASSERT_EQ(some.size(), 4U);
    EXPECT_EQ(some[1].line, 2);
    EXPECT_EQ(some[3].line, 4);
    std::string text;
    for (int i = 0; i < 100; ++i) { text += "G7\n"; }
    EXPECT_EQ(errors(text).size(), kMaxGcodeErrors);
}

TEST(GcodeErrors, ByteOrderMarkAtTheStartIsAccepted) {
    EXPECT_EQ(errors("\xef\xbb\xbfG0 X1\n").size(), 0U);
    const auto wrong = errors("\xef\xbb\xbfG7\n");
    ASSERT_EQ(wrong.size(), 1U);
    EXPECT_EQ(wrong[0].column, 1) << "as an editor counts";
}

TEST(GcodeErrors, OfTheLastLineOfALoopNamesThisLine) {
    const auto found =
        errors("o1 repeat [1]\nG1 X 1  Y 1  F[0.001]  (a line that is longer than a short text)\no1 endrepeat\n");
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].line, 2);
    EXPECT_EQ(found[0].column, 1);
    EXPECT_THAT(found[0].message, HasSubstr("F0.001 is too slow"));
}

TEST(GcodeErrors, ReportsTheRestAfterAnEndInAWrongBlock) { EXPECT_EQ(errors("G7 M2\nG7\n").size(), 2U); }

}  // namespace
}  // namespace lockstep
