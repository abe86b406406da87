// Random programs: LinuxCNC's interpreter and ours do the same, or both refuse the program.
//
// LinuxCNC's interpreter as a library gives all digits of motions, centres, feeds and dwells, which are compared to
// 1e-6. The program rs274 gives every call with four decimals, the refusals, and the parameters that a program leaves.
// Places that a program prints itself, (debug,#5420), have six decimals. LOCKSTEP_ORACLE_COUNT sets the number of
// programs, and LOCKSTEP_ORACLE_SEED the first seed.
//
// differences.cpp has differences that are intended, with the condition of each. The generator leaves out these others;
// each item says what our interpreter does, then what rs274 does:
// - F in the block of G20 or G21 counts in the new units, as in grbl. rs274 counts it in the old units.
// - A canned cycle crosses at the greater of two heights, as LinuxCNC's documentation says. Where R changes between
//   cycles without G80, or G98 follows G99, rs274 crosses aslant, or goes down first.
// - A rotation (G10 L2 R) while G92 holds keeps the axes where they stand. rs274 turns the G92 offsets as well, and
//   then moves axes that the block does not name.
// - Tool lengths keep their size over G20 and G21. rs274 takes their number as one of the new units. The same holds for
//   the feed that M72 and M73 restore, which rs274 also rounds to a tenth.
// - continue in a do loop does not affect later loops. rs274 repeats the next repeat loop again, or forever.
// - #<a>=[#<a>+1] is refused if #<a> has no value. rs274 takes 0.
// - A call finds a subroutine anywhere after it. rs274 does not find one that it has skipped on the way to another.
// - M66 to M68 need whole numbers of outputs from 0, and M67 and M68 need a Q. rs274 rounds and guesses.
// - A % may follow blanks, and a line may have 256 characters. Labels of O-words are checked at the end of the body.
//   rs274 checks them at the end of the program: it accepts an if without endif.
// - rs274 by itself is an inch machine without a tool changer. It has its own values of #5400 to #5413, and its own
//   places of the axes after M6 and M61.
// - With cutter compensation, messages, T and stops come when the motions before them are done. rs274 gives messages
//   and T at once, and stops at the end of a motion that the next corner would have shortened. M61 is refused then;
//   rs274 loses a motion at it.
// - If an arc's radius changes a little from its start to its end, a corner is found with the radius at the corner.
// - The first motion after cutter compensation may not be a spline. An L beside G41 or G42 is refused; rs274 ignores
//   it.
// - Probing moves (G38.2 to G38.5) are not compared: rs274 alone rests a hundredth of an inch before their end, and
//   reports that they did not touch. Here a text without a machine touches at the end.
// - Refused by name: G7, G33, G70 to G72, G74, G76, G84, G87, G88, G95, G96, M19, M98 to M199.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include "tests/integration/oracle/compare.hpp"
#include "tests/integration/oracle/generator.hpp"
#include "tests/integration/oracle/rs274.hpp"

namespace lockstep::oracle {
namespace {

constexpr double kTurns_mm = 1e-5;  // in a shorter move only turning axes move

std::uint32_t number_from(const char* name, std::uint32_t usual) {
    const char* text = std::getenv(name);
    return text == nullptr ? usual : static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10));
}

class Oracle : public testing::Test {
protected:
    void SetUp() override {
        if (!is_rs274_installed()) { GTEST_SKIP() << "rs274 is not installed; apt-get install linuxcnc-uspace"; }
    }

    template <typename Make>
    void compare_all(std::uint32_t count, Make make) {
        const std::uint32_t first = number_from("LOCKSTEP_ORACLE_SEED", 1);
        const std::uint32_t programs = number_from("LOCKSTEP_ORACLE_COUNT", count);
        std::uint32_t taken = 0;
        int failures = 0;
        for (std::uint32_t seed = first; seed < first + programs && failures < 20; ++seed) {
            const std::string text = make(seed);
            const Reading ours = read_with_ours(text);
            const std::string difference = compare(text, read_with_rs274(text), ours);
            taken += ours.taken ? 1 : 0;
            if (difference.empty()) { continue; }
            ++failures;
            ADD_FAILURE() << "seed " << seed << ": " << difference << "\n" << text;
        }
        RecordProperty("programs", std::to_string(programs));
        RecordProperty("taken", std::to_string(taken));
        std::printf("%u programs, %u taken\n", programs, taken);
    }
};

/// Leaves out calls that the library does not report, and feeds of moves that only turn: it gives these in lengths.
std::vector<Call> motions_of(const std::vector<Call>& calls) {
    constexpr std::array kNames{"rapid", "feed", "arc", "centre", "dwell"};
    std::vector<Call> motions;
    std::vector<double> at(3);
    for (Call call : calls) {
        if (std::ranges::find(kNames, call.name) == kNames.end()) { continue; }
        const bool is_move = call.name == "rapid" || call.name == "feed" || call.name == "arc";
        const std::vector<double> to{call.numbers.begin(), call.numbers.begin() + (is_move ? 3 : 0)};
        const auto is_same = [](double a, double b) { return std::abs(a - b) < kTurns_mm; };
        if (call.name == "feed" && std::ranges::equal(to, at, is_same)) { call.numbers.back() = 0; }
        if (is_move) { at = to; }
        motions.push_back(std::move(call));
    }
    return motions;
}

double greatest_difference(const std::vector<Call>& theirs, const std::vector<Call>& ours) {
    double greatest = 0;
    for (std::size_t i = 0; i < std::min(theirs.size(), ours.size()) && equal(theirs[i], ours[i]); ++i) {
        for (std::size_t k = 0; k < ours[i].numbers.size(); ++k) {
            greatest = std::max(greatest, std::abs(theirs[i].numbers[k] - ours[i].numbers[k]));
        }
    }
    return greatest;
}

TEST_F(Oracle, MotionsAreEqualToAMillionthOfAMillimetre) {
    const std::uint32_t first = number_from("LOCKSTEP_ORACLE_SEED", 1);
    std::vector<std::string> texts;
    for (std::uint32_t i = 0; i < number_from("LOCKSTEP_ORACLE_COUNT", 400); ++i) {
        texts.push_back(plain_program(first + i));
    }
    const auto theirs = motions_with_all_digits(texts);
    ASSERT_EQ(theirs.size(), texts.size()) << "rs274's library has failed";
    double greatest = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const auto ours = motions_of(read_with_ours(texts[i]).calls);
        const auto their_motions = motions_of(theirs[i]);
        const Difference difference = difference_of_calls(texts[i], their_motions, ours);
        EXPECT_TRUE(difference.text.empty() || difference.is_listed)
            << "seed " << first + i << ": " << difference.text << "\n"
            << texts[i];
        greatest = std::max(greatest, greatest_difference(their_motions, ours));
        count += ours.size();
    }
    std::printf("%zu programs, %zu motions, centres and dwells, at most %g apart\n", texts.size(), count, greatest);
}

TEST_F(Oracle, ValidProgramsDoTheSame) { compare_all(100, valid_program); }

TEST_F(Oracle, ProgramsWithAnOddWordAreTakenOrRefusedAlike) { compare_all(300, odd_program); }

}  // namespace
}  // namespace lockstep::oracle
