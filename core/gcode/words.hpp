// A line of G-code as words: a letter and a number each (RS274/NGC, section 3.3). Spaces may stand anywhere, also
// inside a number; letters may be small or capital; comments are ( ) and ; to the end of the line.
#pragma once

#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "core/gcode/error.hpp"

namespace lockstep {

inline constexpr std::size_t kMaxGcodeLineLength = 256;
/// Numbers beyond this, either way, are refused: sums of them stay exact to far below a step.
inline constexpr double kMaxGcodeNumber = 1e6;

struct GcodeWord {
    char letter = 0;  // capital
    double value = 0;
    int column = 0;    // of the letter
    std::string text;  // as written, without spaces, the letter capital
};

struct GcodeLine {
    bool tape_mark = false;  // the line is a %
    bool deletable = false;  // it begins with /
    std::vector<GcodeWord> words;
};

/// The line is given without its end; `number` is its place in the text, for the error.
std::expected<GcodeLine, GcodeError> split_gcode_line(std::string_view line, int number);

}  // namespace lockstep
