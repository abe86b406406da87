// The steps of a block's execution. Each step handles its own words of the block, if there are any.
#pragma once

#include "core/gcode/run/context.hpp"

namespace lockstep::gcode {

/// Runs a block that has been read: all its steps in RS274's order. After an error the remaining steps do not run.
Result run_block(Context& context);

// check.cpp: errors of the block as a whole, and the motion that it runs.
Result choose_motion(Context& context);
Result check_letters(Context& context);

// modes.cpp
Result set_units(Context& context);
Result set_feed_mode(Context& context);
Result set_feed(Context& context);
Result set_plane(Context& context);
Result set_path_mode(Context& context);
Result set_distance_modes(Context& context);

// events.cpp
Result comment(Context& context);
Result spindle_speed(Context& context);
Result select_tool(Context& context);
Result outputs(Context& context);
Result change_tool(Context& context);
Result spindle(Context& context);
Result coolant(Context& context);
Result overrides(Context& context);
Result dwell(Context& context);
Result stop(Context& context);
/// The text of a comment, with the values of parameters in place of their names.
std::string message_text(const Context& context, std::string_view text);

// keeping.cpp: M70 to M73
Result keep_state(Context& context);
/// Sets the modes to `modal`, and emits an event for each change.
void restore(Context& context, const Modal& modal);

// offsets.cpp, tools.cpp, home.cpp: G10 G43 G49 G52 to G59.3 G92, G28 G30
Result tool_length(Context& context);
Result choose_system(Context& context);
Result non_modal(Context& context);
Result set_system(Context& context);
Result set_tool(Context& context);
Result go_home(Context& context);
Result offset_axes(Context& context);
/// Updates the program's coordinates of the place where the axes stand, after a change of offsets.
void offsets_changed(Context& context);

// compensation.cpp: G40 G41 G42
Result compensation(Context& context);

// motions
Result run_motion(Context& context);
Result straight(Context& context);
Result arc(Context& context);
Result cubic_spline(Context& context);
Result quadratic_spline(Context& context);
Result nurbs(Context& context);
Result canned_cycle(Context& context);
Result probe(Context& context);

/// Returns an error if a motion at feed is not possible: no feed, or no F with inverse time.
Result check_feed(const Context& context);
/// The feed of a motion between two places of the program, per minute. `path`: the length of its path in X, Y and Z.
double feed_of(const Context& context, const Point& from, const Point& to, std::optional<double> path = {});
/// Moves the axes straight to a place of the program. A feed of 0 means rapid.
void move(Context& context, const Point& target, double feed);
/// The machine's coordinates of a place of the program. Axes that do not move keep theirs exactly.
Point machine_target(const Offsets& offsets, const Standing& from, const Point& program);
Point machine_target(const State& state, const Point& program);

/// G38.2 to G38.5.
constexpr bool is_probing(int motion) { return motion >= 382 && motion <= 385; }
/// G73 and G81 to G89; `motion` is the G code's number times ten.
constexpr bool is_cycle(int motion) { return motion == 730 || (motion > 800 && motion < 900); }

}  // namespace lockstep::gcode
