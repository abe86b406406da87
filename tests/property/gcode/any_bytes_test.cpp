// No bytes make the reader fail or exceed its limits; the same bytes give the same result.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "core/gcode/gcode.hpp"

namespace lockstep {
namespace {

const GcodeSetup& setup() {
    static const GcodeSetup value{.program_name = "any",
                                  .axes = {{"X", 0, 200, 5, 0}, {"Y", -50, 50, 0, 1}, {"C", -360, 360, 0, 0}}};
    return value;
}

void check_target(const std::vector<double>& target) {
    RC_ASSERT(target.size() == setup().axes.size());
    for (std::size_t axis = 0; axis < target.size(); ++axis) {
        RC_ASSERT(target[axis] >= setup().axes[axis].min_mm);
        RC_ASSERT(target[axis] <= setup().axes[axis].max_mm);
    }
}

void check_block(const Block& block) {
    RC_ASSERT(block.line >= 1);
    if (const auto* move = std::get_if<ProgramMove>(&block.action)) {
        check_target(move->target_mm);
        RC_ASSERT(move->rapid || (move->feed_mm_s > 0 && move->feed_mm_s <= kMaxFeed_mm_s));
    } else if (const auto* dwell = std::get_if<Dwell>(&block.action)) {
        RC_ASSERT(dwell->seconds >= 0 && std::isfinite(dwell->seconds));
    }
}

/// The result is either a program within travel, or errors with a place in the text.
void check(const std::string& text) {
    const auto result = parse_gcode(text, setup());
    if (!result) {
        RC_ASSERT(!result.error().empty());
        for (const GcodeError& error : result.error()) {
            RC_ASSERT(error.line >= 1 && error.column >= 1 && !error.message.empty());
        }
        RC_ASSERT(parse_gcode(text, setup()).error() == result.error());
        return;
    }
    for (const Block& block : result->blocks) { check_block(block); }
}

/// An axis word, or none. Its value is so small that most programs stay within travel in any mode.
rc::Gen<std::string> word(char letter, int min, int max) {
    return rc::gen::map(rc::gen::inRange(min, max), [letter](int tenths) {
        return tenths % 3 == 0 ? "" : " " + std::string(1, letter) + std::to_string(tenths / 10.0);
    });
}

rc::Gen<std::string> line() {
    const auto code = rc::gen::element<std::string>("", "G0", "g1", "G4 P1", "G20", "G21 G90", "G28", "G90", "G91",
                                                    "G92 C1", "G92.1", "M0", "M1", "N7 G1 F300", "F60", "(c)", "/");
    const auto words = rc::gen::tuple(word('X', 0, 30), word('y', -30, 30), word('C', -40, 40));
    return rc::gen::map(rc::gen::pair(code, words), [](const auto& parts) {
        const auto& [x, y, c] = parts.second;
        return parts.first + x + y + (parts.first.ends_with("C1") ? "" : c) + "\n";
    });
}

rc::Gen<std::string> program() {
    return rc::gen::map(rc::gen::container<std::vector<std::string>>(line()), [](const auto& lines) {
        std::string text = "G1 F300\n";
        for (const std::string& one : lines) { text += one; }
        return text;
    });
}

/// Overwrites, removes or inserts bytes anywhere.
std::string mutated(std::string text) {
    const auto count = *rc::gen::inRange<std::size_t>(1, 8);
    for (std::size_t i = 0; i < count && !text.empty(); ++i) {
        const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
        const char byte = *rc::gen::arbitrary<char>();
        switch (*rc::gen::inRange(0, 3)) {
            case 0: text[at] = byte; break;
            case 1: text.erase(at, 1); break;
            default: text.insert(at, 1, byte); break;
        }
    }
    return text;
}

RC_GTEST_PROP(GcodeOfAnyBytes, IsReadOrRefused, (const std::string& text)) { check(text); }

RC_GTEST_PROP(GcodeOfAnyBytes, ProgramsKeepWithinTravelOrAreRefused, ()) { check(*program()); }

RC_GTEST_PROP(GcodeOfAnyBytes, MutatedProgramsAreReadOrRefused, ()) { check(mutated(*program())); }

/// Random bytes rarely form words; these characters do.
RC_GTEST_PROP(GcodeOfAnyBytes, RandomTextOfItsOwnCharactersIsReadOrRefused, ()) {
    check(*rc::gen::container<std::string>(rc::gen::elementOf(std::string("GMNFPXYC0129.-+/%;() \t\r\n"))));
}

/// Absolute and relative moves reach the same position.
RC_GTEST_PROP(GcodeOfAnyBytes, RelativeAndAbsoluteMovesReachTheSamePositions, ()) {
    const auto places = *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 200)));
    std::string absolute = "G0\n";
    std::string relative = "G91 G0\n";
    for (int at = 0; const int place : places) {
        absolute += "X" + std::to_string(place) + "\n";
        relative += "X" + std::to_string(place - at) + "\n";
        at = place;
    }
    const auto one = parse_gcode(absolute, setup());
    const auto other = parse_gcode(relative, setup());
    RC_ASSERT(one.has_value() && other.has_value());
    RC_ASSERT(one->blocks.size() == other->blocks.size());
    for (std::size_t i = 0; i < one->blocks.size(); ++i) {
        RC_ASSERT(std::get<ProgramMove>(one->blocks[i].action).target_mm ==
                  std::get<ProgramMove>(other->blocks[i].action).target_mm);
    }
}

}  // namespace
}  // namespace lockstep
