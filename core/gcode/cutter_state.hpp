// The state of cutter compensation between blocks. The last motion waits, because the next corner may move its end.
//
// While compensation is on, the places of State are programmed ones. The place of the tool's centre is here.
#pragma once

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "core/gcode/flat.hpp"
#include "core/gcode/motion.hpp"

namespace lockstep::gcode {

/// A motion of the tool's centre, in the program's coordinates.
struct CutMove {
    Point target{};
    Flat from;                   // where it begins, in the plane
    Flat direction;              // of a straight motion, as programmed; 0 for the entry, or if the plane's axes rest
    std::optional<Flat> centre;  // of an arc
    double radius = 0;           // of an arc, where it ends
    double sweep = 0;            // of an arc, as programmed, without whole turns
    int turns = 1;               // of an arc: see Arc
    double feed = 0;
    bool rapid = false;
};

/// The greatest number of motions and events in one place of the plane.
inline constexpr std::size_t kMostWaiting = 10'000;

/// The waiting motion, or a motion or an event after it.
struct Waiting {
    int line = 0;
    std::variant<CutMove, Action> what;
};

/// One place in both coordinate systems.
struct Standing {
    Point program{};
    Point machine{};
};

struct CutterState {
    bool entered = false;            // the entry motion has been read
    Flat at;                         // the tool's centre where the last motion ends
    Flat tip;                        // from the centre to the reference place of the offset of a lathe tool
    std::vector<Waiting> waiting;    // the first is a CutMove
    std::optional<Standing> stands;  // where the axes stand, until a motion without compensation ends
};

}  // namespace lockstep::gcode
