// The state of a machine for G-code. A program begins with a state and changes it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "core/gcode/cutter_state.hpp"
#include "core/gcode/flat.hpp"
#include "core/gcode/motion.hpp"
#include "core/gcode/text/parameters.hpp"
#include "core/program_devices.hpp"

namespace lockstep::gcode {

inline constexpr std::size_t kSystems = 9;  // G54 to G59.3

enum class Plane : std::uint8_t { XY, ZX, YZ };                 // G17 G18 G19
enum class FeedMode : std::uint8_t { PerMinute, InverseTime };  // G94 G93
enum class Side : std::uint8_t { None, Left, Right };           // G40 G41 G42
inline constexpr int kNoMotion = -1;                            // after G80, and at the start

/// The modes: a word sets them, and they hold for the lines after it.
struct Modal {
    int motion = kNoMotion;  // the G code's number times ten: G5.2 is 52
    Plane plane = Plane::XY;
    bool inches = false;            // G20
    bool relative = false;          // G91
    bool centres_absolute = false;  // G90.1
    bool retract_to_start = false;  // G98; false, G99: to R
    FeedMode feed_mode = FeedMode::PerMinute;
    double feed_linear = 0;   // mm/min; 0: none yet
    double feed_turning = 0;  // degrees/min
    double spindle_speed = 0;
    SpindleDirection spindle = SpindleDirection::Stopped;
    bool mist = false;
    bool flood = false;
    bool feed_override = true;
    bool speed_override = true;
    bool adaptive_feed = false;
    bool feed_hold = true;
    std::size_t system = 0;  // 0 is G54
    int path_mode = 640;     // G61 610, G61.1 611, G64 640
    double path_tolerance = 0;
    Side side = Side::None;
    double tool_radius = 0;  // of the compensation, mm; 0: it has no effect
    bool operator==(const Modal&) const = default;
};

struct Tool {
    int pocket = 0;
    Point offset{};
    double diameter = 0;
    double front_angle = 0;
    double back_angle = 0;
    int orientation = 0;
    bool operator==(const Tool&) const = default;
};

/// The origin of the program's coordinates: machine = turned(program + g92) + origin + tool.
struct Offsets {
    Point origin{};       // of the chosen coordinate system
    double rotation = 0;  // of the chosen coordinate system, degrees counterclockwise about Z
    Point g92{};
    Point tool{};
    bool operator==(const Offsets&) const = default;
};

/// Words of a canned cycle that also hold for the same cycle in later blocks, in mm.
struct CycleWords {
    std::optional<double> clear;  // R
    std::optional<double> bottom;
    std::optional<double> dwell;  // P
    std::optional<double> peck;   // Q
    double start = 0;             // the height where the first of several cycles began
};

inline constexpr int kMaxSplineOrder = 10;

/// Data of a spline for later blocks, in mm.
struct SplineWords {
    std::optional<Flat> direction;  // G5: its P and Q
    std::optional<Spline> nurbs;    // between G5.2 and G5.3
    Point end{};                    // the end of `nurbs` so far, in the program's coordinates
};

/// The modes stored by M70 or M73, separate for each subroutine call.
struct KeptModes {
    std::optional<Modal> modal;
    bool restores_at_return = false;  // M73
};

struct State {
    Point machine{};  // where the axes stand
    Point program{};  // the same place in the program's coordinates
    Modal modal;
    Offsets offsets;
    CycleWords cycle;
    SplineWords spline;
    CutterState cutter;
    int selected_tool = 0;
    int tool = 0;  // in the spindle; 0: none
    std::map<int, Tool> tools;
    ParameterValues parameters;
};

// The last probing move's result: nine numbers in the program's coordinates and units, and 1 if it touched.
inline constexpr int kTouchParameter = 5061;
inline constexpr int kTouchedParameter = 5070;
// Parameters that hold places: nine numbers each, in mm and degrees, in machine coordinates.
inline constexpr int kHomeParameter = 5161;        // G28
inline constexpr int kSecondHomeParameter = 5181;  // G30
inline constexpr int kG92UsedParameter = 5210;     // 1: the G92 offsets below hold
inline constexpr int kG92Parameter = 5211;
inline constexpr int kSystemParameter = 5220;  // 1 is G54
/// The first of the parameters of a coordinate system: nine for its origin, the tenth is its rotation.
constexpr int origin_parameter(std::size_t system) { return 5221 + static_cast<int>(system) * 20; }

Point place_of(const ParameterValues& parameters, int first);
void set_place(ParameterValues& parameters, int first, const Point& place);

/// Convert between the program's coordinates and the machine's.
Point to_machine(const Offsets& offsets, const Point& program);
Point to_program(const Offsets& offsets, const Point& machine);

/// Chooses a coordinate system: 0 is G54.
void begin_system(State& state, std::size_t system);

/// Sets the parameters of a probing move's result, and the axes' place behind it.
void note_touch(State& state, const Touch& touch);

/// Takes the offsets from the parameters, and computes the axes' place in the program's coordinates.
void begin(State& state);

}  // namespace lockstep::gcode
