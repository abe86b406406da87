// A G-code text becomes a motion program: everything modal resolved, every target absolute in machine coordinates.
//
// The language is RS-274/NGC as LinuxCNC has it; docs/gcode.md lists it, and tests/integration/oracle compares it with
// LinuxCNC's own interpreter. What a machine adds:
// - F below kMinFeedPerMinute is refused as a mistake in the units.
// - A target outside travel is refused. A move to where the axes already stand is left out.
// - Axes of longer names than a letter stay where they are.
// - G28 and G30 go to the park position until G28.1 or G30.1 sets another; they do not home.
// - Splines are cut into chords (chords.hpp), and arcs that lie in no plane of two axes.
// - Coordinate systems, offsets and the tool table are inputs, and come back as the program leaves them.
// - Words for devices that the machine does not have are refused, or become events on the path, as `unassigned` says.
#pragma once

#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "core/gcode/kept_values.hpp"
#include "core/gcode/motion.hpp"
#include "core/gcode/setup.hpp"
#include "core/gcode/text/error.hpp"
#include "core/program.hpp"
#include "core/unassigned_words.hpp"

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
    bool pause_at_m1 = false;        // optional stop
    bool skip_deletable = true;      // block delete: lines that begin with / are not run
    bool ignore_unassigned = false;  // words for devices that the machine does not have are passed over
};

struct GcodeSetup {
    std::string program_name;
    std::vector<GcodeAxis> axes;
    GcodeSwitches switches;
    UnassignedWords unassigned;
    gcode::KeptValues values;
    double chord_tolerance_mm = 0.001;  // of curves that are cut into chords
    bool curves_as_chords = false;      // for a planner that takes straight moves only
    gcode::Limits limits;
    std::function<std::optional<std::string>(std::string_view name)> find_subroutine;
};

/// A word that was passed over, or a message of the program.
struct GcodeNote {
    int line = 0;
    std::string text;
};

struct GcodeReading {
    Program program;
    std::vector<GcodeNote> notes;  // each word's kind once, with its first line; messages all
    gcode::KeptValues values;      // that the program leaves at its end
};

/// The same text and setup give the same program, bit for bit. Errors are in the order of lines.
std::expected<GcodeReading, std::vector<GcodeError>> read_gcode(std::string_view text, const GcodeSetup& setup);
std::expected<Program, std::vector<GcodeError>> parse_gcode(std::string_view text, const GcodeSetup& setup);

/// One motion of a program, before arcs and splines are cut.
using TakeAction = std::function<void(const gcode::Action& action, int line)>;
/// Hands out the program's actions, without looking at travel or devices.
std::expected<void, std::vector<GcodeError>> gcode_actions(std::string_view text, const GcodeSetup& setup,
                                                           const TakeAction& take);

}  // namespace lockstep
