// One block: a line's words sorted by what they mean, checked by themselves (RS274/NGC, sections 3.4 to 3.6).
//
// A block is what the line says; what it comes to depends on the lines before and is the interpreter's.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/gcode/words.hpp"

namespace lockstep {

namespace gcode {

// The modal groups: at most one word of each in a block.
enum class Motion : std::uint8_t { Rapid, Feed };                             // G0 G1
enum class Immediate : std::uint8_t { Dwell, Park, SetOffset, ClearOffset };  // G4 G28 G92 G92.1: this block only
enum class Units : std::uint8_t { Inches, Millimetres };                      // G20 G21
enum class Distance : std::uint8_t { Absolute, Relative };                    // G90 G91
enum class Stop : std::uint8_t { Pause, OptionalPause, End };                 // M0 M1 M2 M30

}  // namespace gcode

struct GcodeBlock {
    std::optional<gcode::Motion> motion;
    std::optional<gcode::Immediate> immediate;
    std::optional<gcode::Units> units;
    std::optional<gcode::Distance> distance;
    std::optional<gcode::Stop> stop;
    std::optional<GcodeWord> feed;  // F, above 0
    double dwell_seconds = 0;       // with Immediate::Dwell
    std::vector<GcodeWord> axes;    // every letter is one of the machine's
};

/// `axis_letters` are the letters by which the machine's axes are called, capitals. The first thing wrong is the error.
std::expected<GcodeBlock, GcodeError> read_gcode_block(const std::vector<GcodeWord>& words,
                                                       std::string_view axis_letters, int line);

}  // namespace lockstep
