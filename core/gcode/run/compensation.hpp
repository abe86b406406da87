// Cutter compensation, G41 and G42: the path of the tool's centre, a tool radius beside the programmed path.
//
// Inside corners are cut short where the two paths meet; outside corners are rounded. Motions that the tool cannot
// reach without cutting into the path beside them are refused.
#pragma once

#include "core/gcode/run/arc_geometry.hpp"
#include "core/gcode/run/steps.hpp"

namespace lockstep::gcode {

inline constexpr const char* kStraightAfterCompensation =
    " is the first motion after cutter compensation, which must be straight; write G0 or G1 before it";

struct ArcMove {
    Point target{};  // in the program's coordinates
    Flat centre;
    int turns = 1;  // positive: counterclockwise
};

/// Moves along the arc without compensation.
void move_arc(Context& context, const ArcMove& move);
/// The direction of an axis in machine coordinates.
Vector turned_axis(const State& state, std::size_t normal);

/// Whether the tool's centre is beside the path. A radius of 0 leaves it on the path.
inline bool is_offset(const State& state) { return state.modal.side != Side::None && state.modal.tool_radius > 0; }

Result compensated_straight(Context& context, const Point& target, bool rapid);
Result compensated_arc(Context& context, const ArcMove& move);

/// The axes' place that programs read from #5420 on: with compensation the tool's centre.
Point shown_place(const State& state);
/// Emits the waiting motions. The axes then stand at the tool's centre, and the next motion leads back to the path.
void leave_compensation(Context& context);
/// For the end of a program: also sets the state's place to where the axes stand.
void end_compensation(Context& context);

}  // namespace lockstep::gcode
