// Every alteration of a valid record is found, and the tools agree about it.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <tuple>

#include "tests/records/alterations/alterations.hpp"

namespace lockstep::records {
namespace {

/// The record of a base, made once.
const Record& record_of(const Base& base) {
    static std::map<std::string, Record> made;
    const auto found = made.find(base.name);
    return found != made.end() ? found->second : made.emplace(base.name, base.make()).first->second;
}

using Cell = std::tuple<Base, Alteration>;

/// All alterations of all bases that have a place for them.
std::vector<Cell> cells() {
    std::vector<Cell> all;
    for (const Base& base : bases()) {
        for (const Alteration& alteration : alterations()) {
            if (base.fulfils(alteration.needs)) { all.emplace_back(base, alteration); }
        }
    }
    return all;
}

void expect_judged(const Judgement& judgement, const Expected& expected, Altered altered) {
    for (const std::string& wrong : wrong_verdicts(judgement, expected)) { ADD_FAILURE() << wrong; }
    for (const std::string& broken : broken_laws(judgement, expected, altered)) { ADD_FAILURE() << broken; }
}

class AlteredRecord : public testing::TestWithParam<Cell> {};

TEST_P(AlteredRecord, IsJudgedByWhatWasAltered) {
    const auto& [base, alteration] = GetParam();
    Record record = record_of(base);
    ASSERT_TRUE(alteration.alter(record)) << "the record has no place for this alteration";
    expect_judged(judge(record), alteration.expected, alteration.altered);
}

INSTANTIATE_TEST_SUITE_P(All, AlteredRecord, testing::ValuesIn(cells()), [](const auto& cell) {
    return std::get<0>(cell.param).name + "__" + std::get<1>(cell.param).name;
});

class UnalteredBase : public testing::TestWithParam<Base> {};

TEST_P(UnalteredBase, IsExactAndGood) { expect_judged(judge(record_of(GetParam())), kValid, {}); }

INSTANTIATE_TEST_SUITE_P(All, UnalteredBase, testing::ValuesIn(bases()),
                         [](const auto& base) { return base.param.name; });

class DamagedFile : public testing::TestWithParam<FileAlteration> {};

TEST_P(DamagedFile, IsReadAsFarAsItCan) {
    const auto log = record_folder() / "damaged.lcm";
    write_record(record_of(bases().front()), log);
    std::ifstream in(log, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    GetParam().alter(bytes);
    std::ofstream(log, std::ios::binary) << bytes;
    expect_judged(judge_file(log), GetParam().expected, Altered{.motion = false});
    std::filesystem::remove(log);
}

INSTANTIATE_TEST_SUITE_P(All, DamagedFile, testing::ValuesIn(file_alterations()),
                         [](const auto& damage) { return damage.param.name; });

}  // namespace
}  // namespace lockstep::records
