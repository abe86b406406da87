#include "tests/integration/oracle/line_maker.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace lockstep::oracle {

double LineMaker::drawn(double from, double to) {
    const double share = static_cast<double>(random_() % 1'000'000) / 1e6;
    return std::round((from + (to - from) * share) * 1000) / 1000;
}

std::string LineMaker::number(double value) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), one_in(4) ? "%+.4f" : "%.10g", value);
    return text.data();
}

/// Writes a random value in one of the forms of the language.
std::string LineMaker::value(double from, double to) {
    const double wanted = drawn(from, to);
    switch (below(14)) {
        case 0: return "[" + number(wanted) + "]";
        case 1: return "[" + number(wanted / 2) + "*2]";
        case 2: return "[" + number(wanted - 3) + " + 3]";
        case 3: return "[#2 * 0 + " + number(wanted) + "]";
        case 4: return "[" + number(wanted) + " - [1 lt 0]]";
        case 5: return "[" + number(wanted * wanted) + " ** 0.5]";
        case 6: return "#1";
        case 7: return "[" + number(wanted) + " / cos[0] + fix[0.5] - fup[-0.5] mod 3]";
        case 8: return "[#<name> + " + number(wanted) + "]";
        default: return number(wanted);
    }
}

std::string LineMaker::feed() {
    const bool needed = inverse_time_ || !has_feed_ || nested_;
    if (!needed && !one_in(4)) { return ""; }
    has_feed_ = has_feed_ || (!inverse_time_ && !nested_);
    return " F" + number(std::round(drawn(10, 900)));
}

std::string LineMaker::axis_words(const std::string& letters, double reach) {
    std::string text;
    for (const char letter : letters) {
        if (!one_in(2)) { continue; }
        text += (one_in(3) ? "" : " ") + std::string(1, one_in(3) ? static_cast<char>(letter + 32) : letter);
        text += value(-reach, reach);
    }
    return text;
}

std::string LineMaker::straight() {
    const bool is_rapid = one_in(3);
    std::string text = is_rapid ? (one_in(2) ? "G0" : "g00") : (one_in(2) ? "G1" : "G01");
    text += axis_words("XYZ", 60) + (one_in(3) ? axis_words("ABC", 90) : "");
    return is_rapid ? text : text + feed();
}

std::string LineMaker::end_word(char letter, int axis, double offset) {
    if (relative_) { return " " + std::string(1, letter) + number(offset); }
    return " " + std::string(1, letter) + "[#" + std::to_string(5420 + axis) + " + " + number(offset) + "]";
}

std::string LineMaker::centre_word(char letter, int axis, double offset) {
    if (!centres_absolute_) { return " " + std::string(1, letter) + number(offset); }
    return " " + std::string(1, letter) + "[#" + std::to_string(5420 + axis) + " + " + number(offset) + "]";
}

std::string LineMaker::arc_by_radius() {
    constexpr std::array<std::array<int, 2>, 3> kAxes{{{0, 1}, {0, 2}, {1, 2}}};
    const auto axes = kAxes[static_cast<std::size_t>(plane_)];
    const double first = drawn(1, 20);
    const double second = drawn(-20, -1);
    std::string text = end_word("XYZ"[axes[0]], axes[0], first) + end_word("XYZ"[axes[1]], axes[1], second);
    const double least = std::hypot(first, second) / 2;
    return text + " R" + (one_in(3) ? "-" : "") + std::to_string(least + 0.01 + drawn(0, 30));
}

/// How much the radius at the end differs, as a share: mostly a little less than an arc may have.
double LineMaker::other_radius(double radius) {
    const double least = (inches_ ? 0.002 : 0.02) * std::sqrt(2);
    const double allowed = std::max(least, std::min(radius / 1000, 100 * least));
    return (one_in(20) ? 1.03 : 0.97) * drawn(-1, 1) * allowed / radius;
}

/// An arc by radius, or by a centre and an angle that give its end.
std::string LineMaker::arc() {
    constexpr std::array<std::array<int, 3>, 3> kAxes{{{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}};
    const auto axes = kAxes[static_cast<std::size_t>(plane_)];
    std::string text = one_in(2) ? "G2" : "G03";
    if (one_in(3)) {
        text += arc_by_radius();
    } else {
        const double size = one_in(4) ? 80 : 1;
        const double i = size * drawn(1, 20);
        const double j = size * drawn(-20, 20);
        const double angle = drawn(0.1, 6);
        const double ends = one_in(2) ? 1 + other_radius(std::hypot(i, j)) : 1;
        const double x = i - ends * (i * std::cos(angle) - j * std::sin(angle));
        const double y = j - ends * (i * std::sin(angle) + j * std::cos(angle));
        if (!one_in(4)) { text += end_word("XYZ"[axes[0]], axes[0], x) + end_word("XYZ"[axes[1]], axes[1], y); }
        text += centre_word("IJK"[axes[0]], axes[0], i) + centre_word("IJK"[axes[1]], axes[1], j);
    }
    if (one_in(3)) { text += end_word("XYZ"[axes[2]], axes[2], drawn(-10, 10)); }
    if (one_in(5)) { text += " P" + std::to_string(1 + below(3)); }
    if (one_in(6)) { text += " A" + value(-90, 90); }
    return text + feed();
}

std::string LineMaker::cycle() {
    if (inverse_time_) { return "G94"; }
    constexpr std::array<const char*, 8> kCycles{"G81", "G82", "G83", "G73", "G85", "G86", "G89", "G81"};
    constexpr std::array<std::array<char, 3>, 3> kLetters{{{'X', 'Y', 'Z'}, {'X', 'Z', 'Y'}, {'Y', 'Z', 'X'}}};
    const auto letters = kLetters[static_cast<std::size_t>(plane_)];
    const std::string code = kCycles[static_cast<std::size_t>(below(8))];
    const double high = drawn(-20, 20);
    std::string text = code == "G86" ? "M3 S100 G86" : (one_in(5) ? "G98 " : one_in(5) ? "G99 " : "") + code;
    if (plane_ == 0 && one_in(6)) {
        text += " @" + number(drawn(1, 20)) + " ^" + number(drawn(-180, 180));
    } else {
        text += " " + std::string(1, letters[0]) + value(-50, 50) + " " + std::string(1, letters[1]) + value(-50, 50);
    }
    text += " " + std::string(1, letters[2]) + number(relative_ ? -drawn(1, 12) : high - drawn(1, 12)) + " R" +
            number(high);
    if (code == "G83" || code == "G73") { text += " Q" + number(drawn(0.8, 5)); }
    if (code == "G82" || code == "G86" || code == "G89") { text += " P" + number(drawn(0, 2)); }
    if (one_in(4)) { text += " L" + std::to_string(1 + below(3)); }
    return text + feed() + "\n" + std::string(1, letters[0]) + value(-50, 50) + "\nG80";
}

std::string LineMaker::spline() {
    if (plane_ != 0 || inverse_time_) { return "G17"; }
    const std::string end = axis_words("X", 40) + " Y" + value(-40, 40);
    const std::string first = " I" + value(-9, 9) + " J" + value(-9, 9);
    std::string text;
    switch (below(3)) {
        case 0: text = "G5" + first + " P" + value(-9, 9) + " Q" + value(-9, 9) + end + feed(); break;
        case 1: text = "G5.1" + first + end + feed(); break;
        default:
            text = "G5.2 X" + value(-9, 9) + " Y" + value(-9, 9) + " P1" + (one_in(2) ? " L3" : "") + feed() +
                   "\nX1 Y" + value(-9, 9) + " P" + number(drawn(0.5, 3)) + "\nX" + value(-9, 9) + " Y9 P1\nG5.3";
    }
    return text + "\n" + report() + "\nG0 X" + number(drawn(200, 300));
}

std::string LineMaker::mode() {
    if (nested_) { return one_in(2) ? "G61" : "G64 P0.1"; }
    switch (below(9)) {
        case 0: relative_ = !relative_; return relative_ ? "G91" : "G90";
        case 1:
            if (!changes_units_) { return "G40"; }
            inches_ = !inches_;
            return inches_ ? "G20" : "G21";
        case 2: plane_ = below(3); return plane_ == 0 ? "G17" : plane_ == 1 ? "G18" : "G19";
        case 3: centres_absolute_ = !centres_absolute_; return centres_absolute_ ? "G90.1" : "G91.1";
        case 4: inverse_time_ = true; return "G93";
        case 5:
            inverse_time_ = false;
            has_feed_ = true;
            return "G94 F" + number(std::round(drawn(10, 500)));
        case 6: return one_in(2) ? "G61.1" : "G64 P0.05 Q0.02";
        case 7: return one_in(2) ? "G98" : "G99";
        default: return "G80";
    }
}

/// Rotations and G92 do not occur in the same program: see the list in oracle_test.cpp.
std::string LineMaker::offset() {
    switch (below(13)) {
        case 0: return "G10 L2 P" + std::to_string(below(10)) + axis_words("XYA", 30) + " Z1";
        case 1:
        case 2: return "G10 L20 P" + std::to_string(below(10)) + axis_words("XYZB", 30);
        case 3:
        case 4: return "G5" + std::to_string(4 + below(6));
        case 5: return "G59." + std::to_string(1 + below(3));
        case 6: return rotates_ ? rotation() : "G52 X" + value(-9, 9) + axis_words("YZC", 9);
        case 7: return rotates_ ? rotation() : "G92 X" + value(-9, 9) + axis_words("YZC", 9);
        case 8: return rotates_ ? "G10 L2 P0 R0" : "G92." + std::to_string(1 + below(3));
        default: return relative_ ? "G4 P0.25" : "G53 G0" + axis_words("XYZ", 40);
    }
}

std::string LineMaker::rotation() {
    return "G10 L2 P" + std::to_string(1 + below(9)) + axis_words("XY", 30) + " R" + number(drawn(-90, 90));
}

std::string LineMaker::home() {
    switch (below(4)) {
        case 0: return "G28.1";
        case 1: return "G30.1";
        case 2: return "G28" + axis_words("XYZA", 20);
        default: return "G30" + axis_words("XYZ", 20);
    }
}

std::string LineMaker::plain_tool() {
    if (changes_units_ || one_in(3)) { return "G49"; }
    const char letter = "XYZ"[below(3)];
    return "G43.1 " + std::string(1, letter) + value(-5, 5);
}

std::string LineMaker::tool() {
    constexpr std::array<int, 3> kTools{1, 2, 3};
    const std::string number = std::to_string(kTools[static_cast<std::size_t>(below(3))]);
    if (is_plain_) { return plain_tool(); }
    switch (changes_units_ ? 0 : below(9)) {
        case 0: return "T" + number;
        case 1: return "G43 H" + number;
        case 2: return "G43.1 X" + value(-5, 5);
        case 3: return "G49";
        case 4: return "G43.1 Z" + value(-5, 5);
        case 5: return "G43.2 H" + number;
        case 6: return "G10 L1 P" + number + " Z" + value(-5, 5) + (one_in(2) ? " R0.5" : "");
        case 7: return "G10 L10 P" + number + " Z" + value(-5, 5);
        default: return "G10 L11 P" + number + " Z" + value(-5, 5);
    }
}

std::string LineMaker::event() {
    constexpr std::array kEvents{"M3 S100",
                                 "M4 S250.5",
                                 "M5",
                                 "M7",
                                 "M8",
                                 "M9",
                                 "M48",
                                 "M49",
                                 "M50 P0",
                                 "M51 P1",
                                 "M52 P1",
                                 "M53 P0",
                                 "M62 P3",
                                 "M63 P2",
                                 "M64 P0",
                                 "M65 P1",
                                 "M67 E1 Q2.5",
                                 "M68 E0 Q-1",
                                 "M66 P0 L0",
                                 "M0",
                                 "M1",
                                 "M60",
                                 "S77",
                                 "G97 S5",
                                 "(a comment) (msg,7)",
                                 "G4 P1.5",
                                 "g04p.25",
                                 "G8",
                                 "(debug,#1 #<name>)"};
    return kEvents[static_cast<std::size_t>(below(static_cast<int>(kEvents.size())))];
}

std::string LineMaker::assignment() {
    switch (below(10)) {
        case 9: return "#3=[exists[#1] + exists[#5602] + exists[##2] + exists[#<name>]] (debug,#3)";
        case 0: return "#1=" + value(-20, 20) + " #2=#1";
        case 1: return "#<name>=[#1 + " + value(-2, 2) + "] (debug,#<name>)";
        case 2: return "#3=atan[" + value(1, 9) + "]/[" + value(-9, 9) + "] (debug,#3)";
        case 3: return "#3=[sin[" + value(0, 90) + "] * sqrt[abs[" + value(-9, 9) + "]]] (debug,#3)";
        case 4:
            return "#3=[round[" + value(-9, 9) + "] + exp[1] - ln[2] + acos[0.5] + asin[0.25] + tan[30]] (debug,#3)";
        case 5: return "#3=[#1 gt 0 and #2 le 5 or #1 ne #2 xor 1] (debug,#3)";
        case 6: return "#<_global>=[#1 mod 7] (debug,#<_global> #<_metric> #<_absolute> #<_plane> #<_coord_system>)";
        case 7: return "(debug,#<_x> #<_y> #<_z> #<_motion_mode> #<_rpm> #<_spindle_on> #<_feed_override>)";
        default: return "##4=" + value(-20, 20) + " (debug,#[#4] exists)";
    }
}

std::string LineMaker::block() {
    switch (below(27)) {
        case 0:
        case 1:
        case 2:
        case 3: return arc();
        case 4:
        case 5: return cycle();
        case 6: return nested_ || is_plain_ ? straight() : spline();
        case 7:
        case 8: return mode();
        case 9:
        case 10:
        case 11: return offset();
        case 12: return home();
        case 13:
        case 14: return tool();
        case 15:
        case 16: return event();
        case 17:
        case 18: return assignment();
        case 20:
        case 21:
        case 22: return plane_ == 2 && !one_in(20) ? straight() : compensated();
        case 19:
            return plane_ != 0 || nested_ ? straight()
                                          : "G0 @" + number(drawn(1, 50)) + " ^" + number(drawn(-180, 180));
        default: return straight();
    }
}

std::string LineMaker::odd_word() {
    constexpr std::array kWords{
        "R1",       "P1",  "P-1",  "L0",  "L2",     "Q1",     "H1",     "D1",      "I1",   "J1",    "K1",
        "E1",       "F0",  "F-1",  "S-1", "T-1",    "T9",     "T1.5",   "G0",      "G1",   "G2",    "G4",
        "G10",      "G28", "G43",  "G53", "G80",    "G81",    "G83",    "G90",     "G91",  "G92",   "G93",
        "G94",      "M3",  "M5",   "M6",  "M62",    "M0",     "M2",     "X",       "X1",   "Y1",    "Z1",
        "A1",       "[1",  "1]",   "#",   "#1",     "#0",     "#<x>",   "X[1/0]",  "G1.5", "G54",   "X[sqrt[-1]]",
        "(",        ")",   "N5",   "G18", "M8",     "G61",    "G98",    "G49",     "G52",  "G92.1", "G10 L2",
        "X#<none>", "G5",  "G5.1", "G40", "G41 D2", "G42 D3", "G41 D1", "G42.1 D2"};
    return kWords[static_cast<std::size_t>(below(static_cast<int>(kWords.size())))];
}

}  // namespace lockstep::oracle
