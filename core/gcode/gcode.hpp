// A G-code text becomes a motion program: everything modal resolved, every target absolute in machine coordinates.
//
// Words: G0 G1 G4 G20 G21 G28 G90 G91 G92 G92.1 F P N M0 M1 M2 M30 and the machine's axes that a single letter names.
// Meanings are RS274/NGC's (Kramer, Proctor, Messina: The NIST RS274/NGC Interpreter, version 3) as LinuxCNC has
// them; where they leave a choice:
// - At the start: G21, G90, no feed, no offset, and no motion mode: the first axis words need a G0 or a G1.
// - F is per minute in the block's own units, along the path of the linear axes; where only rotary axes (A, B, C)
//   move, along theirs, in degrees. What the machine calls mm is degrees for them, and G20 does not touch it.
// - A motion word with no axis words selects the mode; a move to where the axes already stand is left out.
// - G28 goes, rapidly, through the point its words name to the park position of these axes, or of all if it names
//   none. It does not home.
// - Text after M2, M30 or the second % is ignored; the end of the text ends the program too.
#pragma once

#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "core/gcode/error.hpp"
#include "core/program.hpp"

namespace lockstep {

/// Reading stops after so many errors.
inline constexpr std::size_t kMaxGcodeErrors = 20;
/// A target this little outside travel is the sum of roundings, and is meant to be on the limit.
inline constexpr double kTravelTolerance_mm = 1e-6;
/// Slower than this is a mistake in the units (mm/min, degrees/min).
inline constexpr double kMinFeedPerMinute = 0.01;

/// All in machine coordinates, finite, min <= max.
struct GcodeAxis {
    std::string name;
    double min_mm = 0;
    double max_mm = 0;
    double park_mm = 0;   // where G28 goes
    double start_mm = 0;  // where the axis stands when the program begins
};

struct GcodeSwitches {
    bool pause_at_m1 = false;    // optional stop
    bool skip_deletable = true;  // block delete: lines that begin with / are not run
};

struct GcodeSetup {
    std::string program_name;
    std::vector<GcodeAxis> axes;
    GcodeSwitches switches;
};

/// The same text and setup give the same program, bit for bit. Errors are in the order of lines.
std::expected<Program, std::vector<GcodeError>> parse_gcode(std::string_view text, const GcodeSetup& setup);

}  // namespace lockstep
