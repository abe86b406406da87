// What cutter compensation keeps between blocks: the last motion waits, because the next corner may move its end.
//
// While it is on, State's places are those of the program; the tool's centre is here.
#pragma once

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
    Flat direction;              // of a straight motion, as programmed; 0: of the entry, or if the plane's axes rest
    std::optional<Flat> centre;  // of an arc
    double radius = 0;           // of an arc, where it ends
    double sweep = 0;            // of an arc, as programmed, without whole turns
    int turns = 1;               // of an arc: see Arc
    double feed = 0;
    bool rapid = false;
};

/// The motion that waits, or a motion or an event after it.
struct Waiting {
    int line = 0;
    std::variant<CutMove, Action> what;
};

/// The same place in both coordinates.
struct Standing {
    Point program{};
    Point machine{};
};

struct CutterState {
    bool entered = false;            // the entry motion has been read
    Flat at;                         // the tool's centre where the last motion ends
    Flat tip;                        // added to the centre: the place on a lathe tool that its offset is measured to
    std::vector<Waiting> waiting;    // the first is a CutMove
    std::optional<Standing> stands;  // where the axes stand, until a motion without compensation ends
};

}  // namespace lockstep::gcode
