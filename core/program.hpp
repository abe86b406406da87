// A motion program: made from a G-code file, planned by a coordinator. Everything modal is resolved.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/enumeration.hpp"
#include "core/pause.hpp"

namespace lockstep {

inline constexpr std::size_t kMaxProgramBlocks = 1'000'000;
inline constexpr double kMaxFeed_mm_s = 1e6;
/// The least speed that may be asked for: of a feed, a jog, or an own move in a given time. deg/s for rotary axes.
inline constexpr double kLeastSpeed_mm_s = 1e-5;
/// The longest time of a motion that an axis makes by itself. Plans of more ticks would not be exact.
inline constexpr double kLongestMotion_s = 30.0 * 86'400;
inline constexpr double kMaxPlace_mm = 1e6;  // either way
inline constexpr double kMaxDwell_s = 86'400;

/// How the path follows the program.
enum class PathMode : std::uint8_t {
    Blend,      // moves are joined where the deviation stays within the tolerance (G64)
    ExactPath,  // every corner is reached exactly, at the speed that the start velocity allows there (G61)
    ExactStop,  // the machine rests at the end of every move (G61.1)
};

/// An arc in the plane of two axes, as the path of a move. All other axes move in proportion to its angle (a helix). If
/// the distances of its ends from the centre differ, the radius changes in proportion to the angle (a spiral).
struct ArcShape {
    std::size_t first = 0;   // axes of the plane, as indices into the move's target;
    std::size_t second = 1;  // counter-clockwise is from the first to the second
    double centre_first_mm = 0;
    double centre_second_mm = 0;
    bool is_clockwise = false;
    std::int32_t turns = 1;  // at least 1: the arc ends when it reaches its end for the nth time
    bool operator==(const ArcShape&) const = default;
};

inline constexpr std::int32_t kMaxTurns = 100'000;
inline constexpr double kMaxCentre_mm = 1e9;      // either way; the centres of nearly straight arcs are far away
inline constexpr double kMaxTolerance_mm = 1000;  // of a joined path

/// A move to an absolute place in machine coordinates, one number per axis of the program.
struct ProgramMove {
    std::vector<double> target_mm;
    double feed_mm_s = 0;         // along the path; unused when rapid
    bool rapid = false;           // as fast as the axes' limits allow
    std::optional<ArcShape> arc;  // absent: straight
    PathMode mode = PathMode::Blend;
    double tolerance_mm = 0;     // for Blend: of each axis, steps included; at least one step
    bool is_feed_fixed = false;  // the feed override has no effect (M49)

    /// The requested feed in mm for each `period_s`; nullopt: as fast as the axes allow.
    std::optional<double> feed_for(double period_s) const {
        return rapid || feed_mm_s <= 0 ? std::nullopt : std::optional(feed_mm_s * period_s);
    }
};

struct Dwell {
    double seconds = 0;
};

/// Come to rest, then continue without a resume. A sender that has no more blocks for now sends it as the last one.
struct Settle {};

/// Come to rest. The straight move that follows, the last one of the program, ends early where an input touches: where
/// it closes or opens (G38.2 to G38.5). The coordinator reports the place.
struct Probe {
    std::int32_t input = 0;  // its number among the inputs for probes
    bool opens = false;      // it touches when it opens
    bool must_touch = true;  // otherwise the program also ends well without a touch
    bool operator==(const Probe&) const = default;
};

inline constexpr std::uint32_t kMaxEventsTogether = 100;  // between two moves, dwells or pauses

/// The words of programs for devices other than axes, one row for each kind: its name in records, its words in a
/// program, and its text for people, with {index} and {value} where these stand. The numbers of kinds are in files and
/// messages: a new kind is the last, here and in idl/proto/program.proto.
// clang-format off
#define LOCKSTEP_PROGRAM_EVENTS(X) \
    /* value: revolutions per minute */ \
    X(SpindleStop,    "spindle-stop",    "M5",                  "spindle stop") \
    X(SpindleForward, "spindle-forward", "M3 S{value}",         "spindle forward, {value} rev/min") \
    X(SpindleReverse, "spindle-reverse", "M4 S{value}",         "spindle reverse, {value} rev/min") \
    X(SpindleSpeed,   "spindle-speed",   "S{value}",            "spindle speed, {value} rev/min") \
    X(CoolantOff,     "coolant-off",     "M9",                  "coolant off") \
    X(MistOn,         "mist-on",         "M7",                  "mist on") \
    X(FloodOn,        "flood-on",        "M8",                  "flood on") \
    X(OutputOn,       "output-on",       "M62 P{index}",        "output {index} on") \
    X(OutputOff,      "output-off",      "M63 P{index}",        "output {index} off") \
    X(AnalogOutput,   "analog-output",   "M67 E{index} Q{value}", "analog output {index} to {value}") \
    /* index: the tool in the spindle, 0: none */ \
    X(Tool,           "tool",            "T{index}",            "tool {index} in the spindle") \
    /* index: the output, value: from each place to the next, mm; PulsePlaces follows */ \
    X(PulseSpacing,   "pulse-spacing",   "M69 P{index} R{value}", "pulses of output {index} every {value} mm") \
    /* index: how many, 0: no more; value: the first place, mm */ \
    X(PulsePlaces,    "pulse-places",    "M69 Q{value} L{index}", "{index} pulses from {value} mm on")
// clang-format on

inline constexpr std::int32_t kMaxEventIndex = 1'000'000;

/// A word of a program for a device other than an axis. The coordinator publishes it when the motion reaches its place.
struct ProgramEvent {
    enum class Kind : std::uint8_t {
#define X(kind, name, words, text) kind,
        LOCKSTEP_PROGRAM_EVENTS(X)
#undef X
    };

    Kind kind = Kind::SpindleStop;
    std::int32_t index = 0;
    double value = 0;
    bool operator==(const ProgramEvent&) const = default;
};

struct EventWords {
    std::string_view name;
    std::string_view words;
    std::string_view text;
};

inline constexpr std::array kEventWords{
#define X(kind, name, words, text) EventWords{name, words, text},
    LOCKSTEP_PROGRAM_EVENTS(X)
#undef X
};

/// As records name it: "output-on".
constexpr std::string_view name_of(ProgramEvent::Kind kind) { return pick_row(kEventWords, kind).name; }

struct Block {
    std::optional<std::int32_t> line;  // in the G-code file, from 1
    std::variant<ProgramMove, Dwell, Pause, Settle, ProgramEvent, Probe> action;
};

struct ProgramHead {
    std::string name;
    std::vector<std::string> axes;
    std::vector<double> start_mm;  // position when the program was made; it is refused at another
};

/// A complete program.
struct Program {
    std::string name;
    std::vector<std::string> axes;
    std::vector<double> start_mm;
    std::vector<Block> blocks;

    ProgramHead head() const { return {name, axes, start_mm}; }
};

/// Returns the part of a program from the first block at or after `line`, for axes that stand at `at_mm`. Unless the
/// axes are already where that block begins, a straight rapid move to there comes first. If no such block exists, the
/// error is the line of the last block; nullopt if there are no blocks.
std::expected<Program, std::optional<std::int32_t>> program_from(const Program& program, std::int32_t line,
                                                                 std::vector<double> at_mm);

/// Returns "line 7: ", or an empty text without a line.
std::string line_label(std::optional<std::int32_t> line);

}  // namespace lockstep
