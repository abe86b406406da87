// Every alteration of a valid record is found, and the tools agree about it.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/records/alterations/alterations.hpp"
#include "tests/records/kept_verdicts.hpp"

namespace lockstep::records {
namespace {

void expect_judged(const Judgement& judgement, const Expected& expected, Altered altered) {
    for (const std::string& wrong : wrong_verdicts(judgement, expected)) { ADD_FAILURE() << wrong; }
    for (const std::string& broken : broken_laws(judgement, expected, altered)) { ADD_FAILURE() << broken; }
}

class AlteredRecord : public testing::TestWithParam<AlteredBase> {};

TEST_P(AlteredRecord, IsJudgedByWhatWasAltered) {
    const auto& [base, alteration] = GetParam();
    Record record = record_of(base);
    ASSERT_TRUE(alteration.alter(record)) << "the record has no place for this alteration";
    const Judgement judgement = judge(record);
    keep_verdicts(GetParam().name(), judgement);
    expect_judged(judgement, alteration.expected, alteration.altered);
}

INSTANTIATE_TEST_SUITE_P(All, AlteredRecord, testing::ValuesIn(altered_bases()),
                         [](const auto& cell) { return cell.param.name(); });

TEST(Alterations, HaveAPlaceInABase) {
    const auto cells = altered_bases();
    for (const Alteration& alteration : alterations()) {
        EXPECT_TRUE(std::ranges::any_of(cells, [&](const AlteredBase& cell) {
            return cell.alteration.name == alteration.name;
        })) << alteration.name;
    }
}

class UnalteredBase : public testing::TestWithParam<Base> {};

TEST_P(UnalteredBase, IsExactAndGood) { expect_judged(judge(record_of(GetParam())), kValid, {}); }

INSTANTIATE_TEST_SUITE_P(All, UnalteredBase, testing::ValuesIn(bases()),
                         [](const auto& base) { return base.param.name; });

class DamagedFile : public testing::TestWithParam<FileAlteration> {};

TEST_P(DamagedFile, IsReadAsFarAsItCan) {
    const Judgement judgement = judge_damaged(GetParam());
    keep_verdicts("damaged " + GetParam().name, judgement);
    expect_judged(judgement, GetParam().expected, kNoMotion);
}

INSTANTIATE_TEST_SUITE_P(All, DamagedFile, testing::ValuesIn(file_alterations()),
                         [](const auto& damage) { return damage.param.name; });

}  // namespace
}  // namespace lockstep::records
