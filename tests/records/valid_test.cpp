// Every valid record is exact and good, as far as it is complete, and the tools agree.
#include <gtest/gtest.h>

#include "tests/random_seeds.hpp"
#include "tests/records/kept_verdicts.hpp"
#include "tests/records/kinds/kinds.hpp"
#include "tests/records/random_program.hpp"

namespace lockstep::records {
namespace {

void expect_judged(const Judgement& judgement, const Expected& expected) {
    for (const std::string& wrong : wrong_verdicts(judgement, expected)) { ADD_FAILURE() << wrong; }
    for (const std::string& broken : broken_laws(judgement, expected)) { ADD_FAILURE() << broken; }
}

class ValidRecord : public testing::TestWithParam<RecordKind> {};

TEST_P(ValidRecord, IsJudgedAsItIs) {
    const Judgement judgement = judge(GetParam().make());
    keep_verdicts("valid " + GetParam().name, judgement);
    expect_judged(judgement, GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(All, ValidRecord, testing::ValuesIn(record_kinds()),
                         [](const auto& kind) { return kind.param.name; });

class RandomProgram : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomProgram, IsExactAndGood) {
    const std::string gcode = random_gcode(GetParam());
    SCOPED_TRACE(gcode);
    expect_judged(judge(recorded_program(gcode)), kValid);
}

class RandomLines : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomLines, OfTwoAxesAreExactAndGood) {
    const std::string gcode = random_lines(GetParam());
    SCOPED_TRACE(gcode);
    expect_judged(judge(recorded_program(small_plotter(), gcode)), kValid);
}

TEST_P(RandomLines, OfASlowAxisAreExactAndGood) {
    const std::string gcode = random_moves_of_one_axis(GetParam());
    SCOPED_TRACE(gcode);
    expect_judged(judge(recorded_program(slow_axis_machine(), gcode)), kValid);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomLines, seeds_from(1, 40));

INSTANTIATE_TEST_SUITE_P(Seeds, RandomProgram, seeds_from(1, 300));

}  // namespace
}  // namespace lockstep::records
