// The supported G and M codes by modal group, and the codes that are refused with a reason.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/enumeration.hpp"

namespace lockstep::gcode {

/// A block has at most one code of each group.
enum class Group : std::uint8_t {
    NonModal,        // G4 G10 G28 G30 G52 G53 G92
    Motion,          // G0 to G5.3 G38 G73 G80 to G89
    Plane,           // G17 G18 G19
    Distance,        // G90 G91
    CentreDistance,  // G90.1 G91.1
    FeedMode,        // G93 G94
    Units,           // G20 G21
    Compensation,    // G40 G41 G42
    ToolLength,      // G43 G49
    Retract,         // G98 G99
    System,          // G54 to G59.3
    PathMode,        // G61 G64
    SpindleMode,     // G97
    Diameter,        // G8
    Stop,            // M0 M1 M2 M30 M60
    Output,          // M62 to M68
    Tool,            // M6 M61
    Spindle,         // M3 M4 M5
    Coolant,         // M7 M8 M9
    Override,        // M48 to M53
    StateKeeping,    // M70 to M73
};
inline constexpr std::size_t kGroups = kCountOf<Group>;

constexpr std::string_view name_of(Group group) {
    return pick_name(
        {"non-modal",    "motion",        "plane",        "distance mode", "arc centre mode",   "feed mode",
         "units",        "compensation",  "tool length",  "retract",       "coordinate system", "path mode",
         "spindle mode", "diameter mode", "stop",         "output",        "tool change",       "spindle",
         "coolant",      "override",      "state keeping"},
        group);
}

struct Code {
    char letter;
    int tenths;  // G92.1 is 921
    Group group;
    std::string_view letters;  // that it uses in addition to axes, F, S and T
};

struct RefusedCode {
    char letter;
    int first;  // tenths
    int last;
    std::string_view reason;
};

/// Returns null if the code is not supported.
const Code* find_code(char letter, int tenths);
/// Returns null if the code is not known at all.
const RefusedCode* find_refused(char letter, int tenths);

}  // namespace lockstep::gcode
