// The values that outlive a program: coordinate systems, the offsets of G92, the places of G28 and G30, and the tool
// table. A program begins with these values and leaves them changed.
//
// The coordinate system in use, the tool in the spindle and all other modes do not outlive it: each program begins with
// G54 and without a tool.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>

#include "core/gcode/state.hpp"

namespace lockstep::gcode {

inline constexpr std::size_t kMaxTools = 200;

struct CoordinateSystem {
    Point origin{};
    double rotation = 0;  // degrees counterclockwise about Z
    bool operator==(const CoordinateSystem&) const = default;
};

/// Places are in machine coordinates, in mm and degrees.
struct KeptValues {
    std::array<CoordinateSystem, kSystems> systems{};  // G54 to G59.3
    Point g92{};
    bool g92_applies = false;          // if false, G92.3 can restore the offsets
    std::optional<Point> home;         // G28.1; none: the park position
    std::optional<Point> second_home;  // G30.1
    std::map<int, Tool> tools;         // at most kMaxTools, by numbers from 1
    bool operator==(const KeptValues&) const = default;
};

/// `park`: the target of G28 and G30 if they have no stored place.
void set_kept_values(State& state, const KeptValues& values, const Point& park);
KeptValues kept_values(const State& state, const Point& park);

/// Returns `now` with all that `left` has changed since `before`.
KeptValues merged(const KeptValues& before, const KeptValues& left, KeptValues now);

/// The values with which a program was read, and those that it leaves.
struct ProgramValues {
    std::uint64_t revision = 0;       // of the machine's values with which it was read
    std::optional<KeptValues> after;  // none: unchanged
    bool at_once = false;             // an edit: `after` applies on arrival, and there is nothing to run
};

}  // namespace lockstep::gcode
