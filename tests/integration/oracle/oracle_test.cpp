// Random programs: LinuxCNC's interpreter and ours do the same, or both refuse the same program.
//
// Places are compared to 1e-6 where the programs print them, (debug,#5420), and to the four decimals of rs274's own
// output elsewhere. More programs: LOCKSTEP_ORACLE_COUNT, from the seed LOCKSTEP_ORACLE_SEED on.
//
// Where we differ on purpose; the generator leaves it out:
// - F in the block of G20 or G21 counts in the new units, as in grbl. rs274: in those before.
// - A canned cycle goes across at the greater of two heights, as LinuxCNC's documentation has it. rs274 goes aslant, or
//   down first, where R changes between cycles without G80.
// - A rotation (G10 L2 R) while G92 holds keeps the axes where they stand. rs274 turns the G92 offsets as well, and
//   then moves axes that the block does not name.
// - Tool lengths keep their size over G20 and G21. rs274 takes their number as one of the new units. The same with the
//   feed that M72 and M73 take up again, which rs274 also rounds to a tenth.
// - continue in a do loop leaves the loops behind it alone. rs274 repeats the next repeat loop again, or for ever.
// - #<a>=[#<a>+1] with an #<a> that has no value is refused. rs274 takes 0.
// - A call finds a subroutine anywhere behind it. rs274 does not find one that it has passed over on the way to
// another.
// - M66 to M68 want whole numbers of outputs from 0, and M67 and M68 a Q. rs274 rounds and guesses.
// - G53 or G10 beside G92.1 in a block is refused: each is a non-modal word. rs274 takes it.
// - A % may stand behind blanks; a line has 256 characters. Labels of O-words are checked where the body ends, not
// where
//   the program does: rs274 takes an if without endif.
// - rs274 by itself is an inch machine without tool changer: #5161 to #5390, #5400 to #5413 and where the axes stand
//   behind M6 and M61 are its own.
// - With cutter compensation messages, T and stops come when the motions before them are done. rs274 gives messages and
//   T at once, and stops at the end of a motion that the next corner would have cut short. M61 and G92.1 to G92.3 are
//   refused meanwhile; rs274 loses a motion at M61.
// - A motion that cutter compensation would have to run backward is refused. rs274 refuses it only before some corners,
//   and calls some arcs a bug of its own. Where a path turns back from arc to arc, their curvature decides whether the
//   corner is inside; rs274 may take it for an outside one and cut into the path.
// - Where an arc's radius changes a little from its start to its end, a corner is found with the radius at the corner.
// - An arc that begins cutter compensation and would reach its end against its own direction is refused,
//   and so is any with a lathe tool; rs274 makes a whole circle of it.
// - G5.2 is refused with cutter compensation; rs274 takes its points. #5420 to #5428 then are the place of the tool's
//   centre; rs274 gives them in messages alone.
// - The first motion after cutter compensation may not be a spline. An L beside G41 or G42 is refused; rs274 passes
// over
//   it.
// - Refused by name: G7, G33, G38, G70 to G72, G74, G76, G84, G87, G88, G95, G96, M19, M98 to M199.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

#include "tests/integration/oracle/generator.hpp"
#include "tests/integration/oracle/rs274.hpp"

namespace lockstep::oracle {
namespace {

std::uint32_t number_from(const char* name, std::uint32_t usual) {
    const char* text = std::getenv(name);
    return text == nullptr ? usual : static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10));
}

std::string line_of(const std::string& text, int number) {
    std::size_t begin = 0;
    for (int i = 1; i < number; ++i) { begin = text.find('\n', begin) + 1; }
    return text.substr(begin, text.find('\n', begin) - begin);
}

/// Up to the end of the shorter: what the refused line did before its error differs.
std::string first_difference(const std::vector<Call>& theirs, const std::vector<Call>& ours) {
    const std::size_t count = std::min(theirs.size(), ours.size());
    for (std::size_t i = 0; i < count; ++i) {
        if (!equal(theirs[i], ours[i])) {
            return "call " + std::to_string(i) + "\n  rs274: " + to_text(theirs[i]) + "\n  ours:  " + to_text(ours[i]);
        }
    }
    return "";
}

/// Messages and T on the one hand, all else on the other.
std::pair<std::vector<Call>, std::vector<Call>> parted(const std::vector<Call>& calls) {
    std::pair<std::vector<Call>, std::vector<Call>> parts;
    for (const Call& call : calls) {
        (call.name == "message" || call.name == "select" ? parts.first : parts.second).push_back(call);
    }
    return parts;
}

/// With cutter compensation rs274 gives messages at once, and motions later.
std::string difference_of(const std::string& text, const Reading& theirs, const Reading& ours) {
    const bool compensates = text.find("G41") != std::string::npos || text.find("G42") != std::string::npos;
    if (!compensates) { return first_difference(theirs.calls, ours.calls); }
    const auto [their_messages, their_calls] = parted(theirs.calls);
    const auto [our_messages, our_calls] = parted(ours.calls);
    const std::string difference = first_difference(their_calls, our_calls);
    return difference.empty() ? first_difference(their_messages, our_messages) : difference;
}

/// What the list says of programs that one of the two refuses.
bool differ_on_purpose(const Reading& theirs, const Reading& ours) {
    const auto is_ours = [&](std::string_view text) { return ours.message.find(text) != std::string::npos; };
    if (ours.taken) {
        return theirs.message.starts_with("BUG: cutter compensation") ||
               theirs.message.starts_with("Cannot read current position with cutter");
    }
    const bool is_beside_g92_1 = is_ours("G92.1") && is_ours("one non-modal word");
    return theirs.taken && (is_ours("without cutting into the path") ||
                            is_ours("G5.2 while cutter compensation is on") || is_beside_g92_1);
}

/// Nothing where the two agree.
std::string compare(const std::string& text) {
    const Reading theirs = read_with_rs274(text);
    const Reading ours = read_with_ours(text);
    if (!theirs.ended || differ_on_purpose(theirs, ours)) { return ""; }
    const std::string difference = difference_of(text, theirs, ours);
    if (!difference.empty()) { return difference; }
    if (theirs.taken != ours.taken) {
        return theirs.taken ? "refused by us alone, line " + std::to_string(ours.line) + ": " + ours.message + "\n  " +
                                  line_of(text, ours.line)
                            : "refused by rs274 alone: " + theirs.message + "\n  " + theirs.refused;
    }
    if (theirs.taken && theirs.calls.size() < ours.calls.size()) {
        return "rs274 does less; then ours: " + to_text(ours.calls[theirs.calls.size()]);
    }
    return "";
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
            const std::string difference = compare(text);
            taken += read_with_ours(text).taken ? 1 : 0;
            if (difference.empty()) { continue; }
            ++failures;
            ADD_FAILURE() << "seed " << seed << ": " << difference;
        }
        RecordProperty("programs", std::to_string(programs));
        RecordProperty("taken", std::to_string(taken));
        std::printf("%u programs, %u taken\n", programs, taken);
    }
};

TEST_F(Oracle, ValidProgramsDoTheSame) { compare_all(100, valid_program); }

TEST_F(Oracle, ProgramsWithAnOddWordAreTakenOrRefusedAlike) { compare_all(300, odd_program); }

}  // namespace
}  // namespace lockstep::oracle
