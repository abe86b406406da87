// Converts a G-code text to a motion program: everything modal resolved, every target absolute in machine coordinates.
//
// The language is RS-274/NGC as in LinuxCNC; docs/gcode.md lists it, and tests/integration/oracle compares it with
// LinuxCNC's own interpreter. Differences and additions:
// - F below kMinFeedPerMinute is refused as a mistake in the units.
// - A target outside travel is refused. A move to the place where the axes already stand is omitted.
// - Axes with names longer than a letter do not move.
// - G28 and G30 go to the park position until G28.1 or G30.1 sets another; they do not home.
// - Splines become arcs (spline_arcs.hpp). Arcs that are not in the plane of two axes are cut into chords (chords.hpp).
// - Coordinate systems, offsets and the tool table are inputs, and are returned as the program leaves them.
// - G38.2 to G38.5 have a P, the number of the probe. Text that is read without a machine takes the touch to be at the
//   end of the move.
// - With a height map, Z of each place is higher by the surface's height there. Moves are cut to follow it.
// - Words for devices that the machine does not have are refused, or become events on the path, as `unassigned` says.
#pragma once

#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/device/input_config.hpp"
#include "core/gcode/curves/height_map.hpp"
#include "core/gcode/kept_values.hpp"
#include "core/gcode/motion.hpp"
#include "core/gcode/setup.hpp"
#include "core/gcode/text/error.hpp"
#include "core/indices.hpp"
#include "core/outputs/assigned_words.hpp"
#include "core/outputs/unassigned_words.hpp"
#include "core/program.hpp"

namespace lockstep {

/// Reading stops after this many errors.
inline constexpr std::size_t kMaxGcodeErrors = 20;
/// A target outside travel by at most this is on the limit: the difference is due to rounding.
inline constexpr double kTravelTolerance_mm = 1e-6;
/// A slower feed counts as a mistake in the units (mm/min, degrees/min).
inline constexpr double kMinFeedPerMinute = 0.01;

/// An axis as the interpreter knows it. Places are in machine coordinates and finite, and min <= max.
struct GcodeAxis {
    std::string name;
    double min_mm = 0;
    double max_mm = 0;
    double park_mm = 0;   // where G28 goes
    double start_mm = 0;  // where the axis stands when the program begins
};

/// An output that makes pulses at places of an axis.
struct GcodePulses {
    std::int32_t number = 0;      // P of M69
    AxisIndex axis;               // in GcodeSetup::axes
    double steps_per_mm = 0;      // of the motor whose device has the output, along the axis
    double least_spacing_mm = 0;  // a pulse ends before the next one at the axis's greatest speed
};

/// How long the spindle may take, before a feed, after it was switched on or got another speed.
struct GcodeSpinUp {
    std::optional<int> input;  // the number of the input that is closed at speed; nullopt: it always takes so long
    double seconds = 0;
};

struct GcodeSwitches {
    bool pause_at_m1 = false;                            // optional stop
    bool skip_deletable = true;                          // block delete: lines that begin with / are not run
    bool ignore_unassigned = false;                      // skips words for devices that the machine does not have
    std::shared_ptr<const HeightMap> heights = nullptr;  // Z follows them; null: the surface is level
};

struct GcodeSetup {
    std::string program_name;
    std::vector<GcodeAxis> axes;
    GcodeSwitches switches;
    UnassignedWords unassigned;
    AssignedWords assigned;
    std::vector<InputConfig> inputs;  // of the machine
    std::vector<GcodePulses> pulses;
    std::optional<GcodeSpinUp> spin_up;
    gcode::KeptValues values;
    double chord_tolerance_mm = 0.001;  // of chords of curves
    bool curves_as_chords = false;      // for a planner that takes straight moves only
    bool awaits_touches = false;  // the touch of each probing move will be given; false: it is the end of the move
    gcode::Limits limits;
    std::function<std::optional<std::string>(std::string_view name)> find_subroutine;
};

/// How a probing move ended. One place for each axis of the setup, in machine coordinates.
struct ProbeTouch {
    bool touched = false;
    std::vector<double> places_mm;            // at the touch; without one, at the end of the move
    std::vector<double> rest_mm;              // where the axes came to rest: the program continues from there
    std::optional<std::uint32_t> input = {};  // of the machine's file, that touched first
};

/// A word that was skipped, or a message of the program.
struct GcodeNote {
    int line = 0;
    std::string text;
};

struct GcodeReading {
    Program program;
    std::vector<GcodeNote> notes;  // each kind of word once, with its first line; all messages
    gcode::KeptValues values;      // at the end of the program
};

/// The same text and setup give the same program, bit for bit. Errors are in the order of lines.
std::expected<GcodeReading, std::vector<GcodeError>> read_gcode(std::string_view text, const GcodeSetup& setup);
std::expected<Program, std::vector<GcodeError>> parse_gcode(std::string_view text, const GcodeSetup& setup);

/// Returns the errors of the text, as read_gcode() does, in memory that does not depend on the number of blocks.
std::vector<GcodeError> check_gcode(std::string_view text, const GcodeSetup& setup);

/// Receives one action of a program, before arcs and splines are cut.
using TakeAction = std::function<void(const gcode::Action& action, int line)>;
/// Passes the program's actions to `take`, without checks of travel or devices.
std::expected<void, std::vector<GcodeError>> gcode_actions(std::string_view text, const GcodeSetup& setup,
                                                           const TakeAction& take);

}  // namespace lockstep
