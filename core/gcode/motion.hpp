// The actions of a G-code program, one value for each: motions in machine coordinates, and events.
//
// Places are in mm, turning axes in degrees. Feeds are per minute: mm along the path of the linear axes; degrees if
// only turning axes move.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/program.hpp"

namespace lockstep::gcode {

inline constexpr std::string_view kAxisLetters = "XYZABCUVW";
inline constexpr std::size_t kAxes = kAxisLetters.size();
using Point = std::array<double, kAxes>;
using Vector = std::array<double, 3>;  // of X, Y and Z

/// The index in kAxisLetters of an axis; nullopt if G-code cannot name it.
constexpr std::optional<std::size_t> axis_place(std::string_view name) {
    if (name.size() != 1) { return std::nullopt; }
    const char letter = name[0] >= 'a' && name[0] <= 'z' ? static_cast<char>(name[0] - 'a' + 'A') : name[0];
    const std::size_t place = kAxisLetters.find(letter);
    return place == std::string_view::npos ? std::nullopt : std::optional(place);
}

constexpr bool is_turning(std::size_t axis) { return axis >= 3 && axis < 6; }

struct Straight {
    Point target{};
    double feed = 0;  // 0: rapid
    bool rapid = false;
};

/// An arc about a line through `centre` along `axis`. X, Y and Z follow the arc to the target, and the other axes move
/// in proportion to the angle. If the radii at the start and the end differ, the radius changes in proportion too.
struct Arc {
    Point target{};
    Vector centre{};
    Vector axis{};  // the plane's normal, of length 1
    int turns = 1;  // of at most a whole turn each; positive: counterclockwise seen from the tip of `axis`
    double feed = 0;
};

/// A NURBS of order `order` (degree + 1) on clamped knots at distance 1. The first and the last point are on it.
struct Spline {
    struct Control {
        Vector at{};
        double weight = 1;
    };
    Point target{};
    int order = 4;
    std::vector<Control> controls;
    double feed = 0;
};

/// A straight move that ends where a probe touches: where its input closes, or opens.
struct Probing {
    Point target{};
    double feed = 0;
    std::optional<int> probe;  // its number; nullopt: the machine's only one
    bool opens = false;
    bool must_touch = true;
};

/// How a probing move ended.
struct Touch {
    bool touched = false;
    Point at{};    // where it touched; without a touch the end of the move
    Point rest{};  // where the axes came to rest, some way behind it
};

enum class EventKind : std::uint8_t {
    Stop,            // M0
    OptionalStop,    // M1
    PalletChange,    // M60
    End,             // M2 M30 %
    ToolSelect,      // T: index
    ToolChange,      // M6: index
    ToolNumber,      // M61: index
    SpindleSpeed,    // S: value
    SpindleForward,  // M3
    SpindleReverse,  // M4
    SpindleStop,     // M5
    Mist,            // M7
    Flood,           // M8
    CoolantOff,      // M9
    Output,          // M62 to M65, M67, M68: switched, index, value
    InputWait,       // M66: index, value: seconds
    Pulses,          // M69: index, value: the first place, spacing, mode: how many
    FeedOverride,    // M48 to M51: value: 1 on, 0 off
    SpeedOverride,
    AdaptiveFeed,  // M52
    FeedHold,      // M53
    PathMode,      // G61 G61.1 G64: index is 610, 611 or 640; value: its P
    Message,       // (MSG, ) (DEBUG, )
    Remark,        // any other comment
    Print,         // (PRINT, )
};

struct Event {
    EventKind kind = EventKind::Stop;
    int index = 0;
    double value = 0;
    std::string text;
    int mode = 0;                   // InputWait and Pulses: L
    bool is_analog = false;         // InputWait: E
    double spacing = 0;             // Pulses: R; as the first place in the program's units
    ProgramEvent::Kind switched{};  // Output
};

using Action = std::variant<Straight, Arc, Spline, Dwell, Probing, Event>;

/// Receives the actions in the order of the program; `line` is the line of the text, from 1.
using Sink = std::function<void(const Action& action, int line)>;

}  // namespace lockstep::gcode
