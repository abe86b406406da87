#include "tests/property/gcode/any_program.hpp"

#include <array>
#include <cctype>
#include <initializer_list>

namespace lockstep {
namespace {

/// The values at limits, and beside them.
constexpr std::string_view kNumbers =
    "0 1 2 3 4 5 9 10 11 90 180 199 200 201 360 5000 5001 86400 86401 99999 100000 100001 1000000 1000001 999999.9 "
    "0.5 0.01 0.009 0.001 0.0001 0.00001 25.4 .5 5. -0 +1 -1 -0.5 1.99999 2.0001 1.00001";

constexpr std::string_view kNumbered =
    "#1 #2 #30 #31 #100 #0 #5000 #5161 #5163 #5181 #5210 #5211 #5213 #5220 #5221 #5223 #5230 #5241 #5250 #5381 #5399 "
    "#5400 #5401 #5403 #5410 #5411 #5412 #5413 #5414 #5419 #5420 #5421 #5422 #5425 #5428 #5429 #5599 #5600 #5601 #5602";

constexpr std::string_view kNamed =
    "#<a> #<b> #<_g> #<never> #<_x> #<_y> #<_z> #<_a> #<_u> #<_w> #<_motion_mode> #<_plane> #<_ccomp> #<_metric> "
    "#<_imperial> #<_absolute> #<_incremental> #<_inverse_time> #<_units_per_minute> #<_coord_system> #<_tool_offset> "
    "#<_retract_r_plane> #<_retract_old_z> #<_ijk_absolute_mode> #<_spindle_on> #<_spindle_cw> #<_mist> #<_flood> "
    "#<_speed_override> #<_feed_override> #<_adaptive_feed> #<_feed_hold> #<_feed> #<_rpm> #<_current_tool> "
    "#<_selected_tool> #<_vmajor> #<_vminor> #<_task> #<_line> #<_call_level> #<_value> #<_value_returned>";

constexpr std::string_view kCodes =
    "G0 G1 G2 G3 G4 G5 G5.1 G5.2 G5.3 G6 G7 G8 G10 G17 G17.1 G18 G19 G20 G21 G28 G28.1 G30 G30.1 G33 G38.2 G40 G41 "
    "G41.1 G42 G42.1 G43 G43.1 G43.2 G49 G50 G52 G53 G54 G55 G56 G57 G58 G59 G59.1 G59.2 G59.3 G59.4 G61 G61.1 G64 G71 "
    "G73 G74 G76 G80 G81 G82 G83 G84 G85 G86 G87 G88 G89 G90 G90.1 G91 G91.1 G92 G92.1 G92.2 G92.3 G93 G94 G95 G96 G97 "
    "G98 G99 G99.5 G100 M0 M1 M2 M3 M4 M5 M6 M7 M8 M9 M19 M30 M48 M49 M50 M51 M52 M53 M60 M61 M62 M63 M64 M65 M66 M67 "
    "M68 M70 M71 M72 M73 M98 M99 M100 M199 M200 G1.05 M3.5 G-1";

constexpr std::array<std::string_view, 92> kStatements{"G91 G2 X10 Y0 I5 J0",
                                                       "G91 G3 X0 Y10 I0 J5 Z",
                                                       "G91 G18 G2 X6 Z0 I3 K0",
                                                       "G91 G19 G3 Y6 Z0 J3 K0",
                                                       "G91 G2 X8 Y8 I8 J0 P2",
                                                       "G93 G91 G2 X10 Y0 I5 J0 F",
                                                       "G93 G3 X Y R F4",
                                                       "G93 G91 G1 X Y F",
                                                       "G0 @ ^",
                                                       "G1 ^",
                                                       "G1 @",
                                                       "G91 G1 @1 ^30 F300",
                                                       "G53 G0 @ ^ X",
                                                       "G0 X Y",
                                                       "G1 X Y",
                                                       "G1 Z F900",
                                                       "G1 X Y Z F",
                                                       "G0 Z",
                                                       "X",
                                                       "X Y",
                                                       "G53 G0 X Y",
                                                       "G53 G1 Z",
                                                       "G53 G2 X Y I J",
                                                       "G2 X Y I J",
                                                       "G3 X Y I J",
                                                       "G2 X Y R",
                                                       "G3 X Y R",
                                                       "G2 X Y I J P",
                                                       "G3 X Y Z I J P3",
                                                       "G2 X Z I K",
                                                       "G3 Y Z J K",
                                                       "G2 I J",
                                                       "G3 X20 Y0 R10",
                                                       "G2 X10 Y10 I5 J5",
                                                       "G3 X0 Y0 I10 J0 Z5 P2",
                                                       "G2 X30 R15.00001",
                                                       "G4 P0.5",
                                                       "G4 P",
                                                       "G5 X Y I J P Q",
                                                       "G5 X Y P Q",
                                                       "G5.1 X Y I J",
                                                       "G5.2 X Y P1 L3",
                                                       "X Y P",
                                                       "G5.3",
                                                       "G10 L1 P1 Z R",
                                                       "G10 L1 P X Q I J",
                                                       "G10 L2 P1 X Y Z",
                                                       "G10 L2 P X R",
                                                       "G10 L20 P0 X Y",
                                                       "G10 L20 P Z",
                                                       "G10 L10 P1 Z",
                                                       "G10 L11 P2 Z",
                                                       "G10 L P X",
                                                       "G28",
                                                       "G28 Z",
                                                       "G28.1",
                                                       "G30 X Y",
                                                       "G30.1",
                                                       "G92 X Y Z",
                                                       "G92.1",
                                                       "G92.2",
                                                       "G92.3",
                                                       "G52 X Y",
                                                       "G41.1 D3",
                                                       "G42.1 D2",
                                                       "G41 D1",
                                                       "G42 D2",
                                                       "G41.1 D L5",
                                                       "G40",
                                                       "G43",
                                                       "G43 H",
                                                       "G43.1 Z",
                                                       "G43.2 H2",
                                                       "G49",
                                                       "G64 P",
                                                       "G64 P Q",
                                                       "G61",
                                                       "G61.1",
                                                       "G73 X Z R Q L",
                                                       "G81 X Y Z-5 R2",
                                                       "G82 X Z R P",
                                                       "G83 X Z-9 R1 Q2",
                                                       "G85 X Z R L2",
                                                       "G86 Z R P0.1",
                                                       "G89 X Y Z R P",
                                                       "G81 X Y R",
                                                       "M62 P",
                                                       "M66 P1 L0 Q",
                                                       "M66 E L",
                                                       "M67 E Q",
                                                       "M68 E1 Q5",
                                                       "M50 P"};

constexpr std::array<std::string_view, 46> kModes{
    "G90", "G91",  "G20",   "G21",    "G17",    "G18",    "G19",     "G54",    "G55",    "G59",  "G59.3", "G93",
    "G94", "F900", "F100",  "F",      "G90.1",  "G91.1",  "G98",     "G99",    "G80",    "M70",  "M71",   "M72",
    "M73", "M48",  "M49",   "M51 P",  "M52 P0", "M53 P1", "M3 S900", "M4",     "M5",     "S",    "M7",    "M8",
    "M9",  "T1",   "T2 M6", "M61 Q1", "M6",     "G97",    "G8",      "M63 P2", "M64 P3", "M65 P"};

constexpr std::array<std::string_view, 12> kComments{"(a remark)",
                                                     "; to the end",
                                                     "(msg, change the tool)",
                                                     "(MSG,)",
                                                     "(debug, #1 is #<a>)",
                                                     "(print,#5420 #<_x> ##)",
                                                     "(debug,#<none> #0 #5603 #x #<open)",
                                                     "/",
                                                     "/ (deletable)",
                                                     "N10",
                                                     "(open",
                                                     "%"};

constexpr std::array<std::string_view, 14> kFunctions{"ABS", "ACOS",  "ASIN", "COS",  "EXP", "FIX",    "FUP",
                                                      "LN",  "ROUND", "SIN",  "SQRT", "TAN", "EXISTS", "NONE"};
constexpr std::string_view kOperators = "** * / MOD + - EQ NE GT GE LT LE AND OR XOR //";

/// The parts, which are computed from left to right: with + the order would be the compiler's choice.
std::string joined(std::initializer_list<std::string> parts) {
    std::string text;
    for (const std::string& part : parts) { text += part; }
    return text;
}

}  // namespace

std::string AnyProgram::word_of(std::string_view words) {
    const auto at = static_cast<std::size_t>(pick(0, static_cast<int>(words.size()) - 1));
    const std::size_t before = words.rfind(' ', at);
    const std::size_t from = before == std::string_view::npos ? 0 : before + 1;
    const std::string_view word = words.substr(from, words.find(' ', from) - from);
    return word.empty() ? word_of(words) : std::string(word);
}

std::string AnyProgram::number() {
    if (one_in(5)) { return word_of(kNumbers); }
    const std::string whole = joined({one_in(4) ? "-" : "", std::to_string(pick(0, 60))});
    return one_in(2) ? whole : whole + "." + std::to_string(pick(0, 9999));
}

std::string AnyProgram::parameter() {
    if (one_in(8)) { return "#[" + std::to_string(pick(1, 40)) + "]"; }
    return word_of(one_in(2) ? kNumbered : one_in(3) ? "#1 #2 #31 #100 #<a> #<b> #<_g>" : kNamed);
}

std::string AnyProgram::expression(int depth) {
    if (depth == 0 || one_in(4)) { return one_in(3) ? parameter() : number(); }
    const int inside = depth - 1;
    switch (pick(0, 5)) {
        case 0: return joined({one_of(kFunctions), "[", expression(inside), "]"});
        case 1: return joined({"ATAN[", expression(inside), "]/[", expression(inside), "]"});
        case 2: return "EXISTS[" + word_of(kNamed) + "]";
        case 3: return "[" + expression(inside) + "]";
        default: return joined({expression(inside), " ", word_of(kOperators), " ", expression(inside)});
    }
}

std::string AnyProgram::value() {
    switch (pick(0, 9)) {
        case 0: return parameter();
        case 1: return "[" + expression(3) + "]";
        case 2: return "[" + expression(1) + "]";
        default: return number();
    }
}

std::string AnyProgram::words(std::string_view letters) {
    std::string words;
    for (const char letter : letters) {
        if (one_in(3)) { words += letter + value() + " "; }
    }
    return words;
}

std::string AnyProgram::filled(std::string_view pattern) {
    std::string line;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        const bool ends = i + 1 == pattern.size() || pattern[i + 1] == ' ';
        line += pattern[i];
        const bool is_letter = std::isalpha(static_cast<unsigned char>(pattern[i])) != 0;
        if (ends && (is_letter || pattern[i] == '@' || pattern[i] == '^')) { line += value(); }
    }
    return line;
}

/// Any codes and words.
std::string AnyProgram::garbage() {
    std::string line;
    for (int n = pick(1, 3); n > 0; --n) { line += word_of(kCodes) + " "; }
    return line + words("XYZAFSTPQRLIJKDHEN");
}

/// With small letters, and often with a wrong character.
std::string AnyProgram::with_noise(std::string line) {
    if (one_in(2)) {
        for (char& c : line) { c = static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }
    }
    const auto at = static_cast<std::size_t>(pick(0, static_cast<int>(line.size())));
    return line.insert(at, word_of("\t . - 0 7 [ ] # < > ( ) ; / * , ? $ = \x7f \xc3 G X N5 E O1"));
}

std::string AnyProgram::line() {
    switch (pick(0, 19)) {
        case 0:
        case 1:
        case 2: return assignment();
        case 3:
        case 4:
        case 5: return filled(one_of(kModes));
        case 6: return joined({filled(one_of(kModes)), " ", statement()});
        case 7: return joined({one_of(kComments), " ", one_in(2) ? statement() : ""});
        case 8: return joined({statement(), " ", one_of(kComments)});
        case 9: return garbage();
        case 10: return with_noise(statement());
        case 11: return joined({word_of("G0 G1 G38.2 G5.3 G28 G92 G10 G43.1 G81"), " ", axes()});
        case 12: return joined({assignment(), " ", assignment(), " ", word_of("X#1 G1 Y#2 F#1 M3")});
        default: return statement();
    }
}

std::string AnyProgram::statement() { return filled(one_of(kStatements)); }

std::string AnyProgram::assignment() { return joined({parameter(), "=", value()}); }

std::string AnyProgram::label() {
    const std::string number = std::to_string(++labels_);
    return one_in(4) ? "o<l" + number + ">" : "o" + number;
}

std::string AnyProgram::condition() { return "[" + expression(2) + "]\n"; }

std::string AnyProgram::flow(int depth) {
    const std::string o = label();
    const std::string inside = body(depth - 1);
    const std::string leave = one_in(3) ? joined({o, " ", word_of("break continue"), "\n"}) : "";
    switch (pick(0, 7)) {
        case 7:  // a second else, or a branch behind it
            return joined(
                {o, " if [0]\n", inside, o, " else\n", o, " ", word_of("else elseif"), " [1]\n", o, " endif\n"});
        case 0: return joined({o, " if ", condition(), inside, o, " endif\n"});
        case 1:
            return joined({o, " if ", condition(), inside, o, " elseif ", condition(), body(depth - 1), o, " else\n",
                           body(depth - 1), o, " endif\n"});
        case 2: return joined({o, " repeat [", number(), "]\n", inside, leave, o, " endrepeat\n"});
        case 3: return joined({"#7=0\n", o, " while [#7 LT 3]\n#7=[#7+1]\n", inside, leave, o, " endwhile\n"});
        case 4: return joined({"#8=0\n", o, " do\n#8=[#8+1]\n", inside, leave, o, " while [#8 LT 3]\n"});
        case 5:
            return joined({o, " sub\n", inside, one_in(3) ? o + " return [#1]\n" : "", o, " endsub ",
                           one_in(2) ? "[#2+1]\n" : "\n", o, " call [", number(), "] ", condition(),
                           "#31=#<_value>\n"});
        default:
            return joined({o, " ", word_of("if endif call while endsub else return repeat"), " ", condition(), inside});
    }
}

/// Relative lines and arcs with cutter compensation, where most corners leave room for the cutter.
std::string AnyProgram::contour() {
    std::string text = joined({"G90 G0 X10 Y10\nG91 ", one_in(8) ? "G18 " : "", word_of("G41.1 G42.1"), " D",
                               word_of("1 2 6 0.5 -2"), "\nG1 X", number(), " Y5\n"});
    for (int n = pick(3, 8); n > 0; --n) {
        const std::string way = std::to_string(pick(-30, 30));
        switch (pick(0, 6)) {
            case 6: text += "G1 X" + way + " Y10 A5 V2\n"; break;
            case 0: text += "G2 X10 Y0 I5 J0\n"; break;
            case 1: text += "G3 X" + way + " Y10 R40\n"; break;
            case 2: text += joined({"G1 Z", number(), "\n"}); break;
            case 3: text += joined({one_of(kModes), "\n"}); break;
            default: text += joined({"G1 X", way, " Y", std::to_string(pick(-30, 30)), "\n"});
        }
    }
    return text + "G40\nG90 G0 X0 Y0\n";
}

std::string AnyProgram::body(int depth) {
    std::string text;
    for (int n = pick(0, 2); n > 0; --n) { text += (one_in(3) ? line() : statement()) + "\n"; }
    return depth > 0 && one_in(2) ? text + flow(depth) : text;
}

std::string AnyProgram::text() {
    std::string text = "G21 F600\n";
    if (one_in(2)) { text += contour(); }
    for (int n = pick(0, 3); n > 0; --n) { text += joined({body(1), flow(2)}); }
    return one_in(4) ? text + "M2\nG7\n" : text;
}

}  // namespace lockstep
