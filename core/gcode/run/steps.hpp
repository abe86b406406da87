// The steps that a block's execution consists of. Each does what the block's words say of its matter, or nothing.
#pragma once

#include "core/gcode/run/context.hpp"

namespace lockstep::gcode {

/// Runs a block that has been read: all its steps in RS274's order. After an error nothing of the rest is done.
Result run_block(Context& context);

// check.cpp: what is wrong with the block whatever the steps do, and which motion it runs.
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
/// The text of a comment, with the values of parameters for their names.
std::string message_text(const Context& context, std::string_view text);

// keeping.cpp: M70 to M73
Result keep_state(Context& context);
/// Makes the modes those of `modal`, and emits the events of what changes.
void restore(Context& context, const Modal& modal);

// offsets.cpp, tools.cpp, home.cpp: G10 G43 G49 G52 to G59.3 G92, G28 G30
Result tool_length(Context& context);
Result choose_system(Context& context);
Result non_modal(Context& context);
Result set_system(Context& context);
Result set_tool(Context& context);
Result go_home(Context& context);
Result offset_axes(Context& context);
/// After a change of offsets: the program's coordinates of where the axes stand.
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

/// Error where a motion at feed cannot be: no feed, or no F with inverse time.
Result check_feed(const Context& context);
/// The feed of a motion between two places of the program, of so long a path of X, Y and Z: per minute.
double feed_of(const Context& context, const Point& from, const Point& to, std::optional<double> path = {});
/// Straight to a place of the program, which becomes the axes'. Feed 0: rapid.
void move(Context& context, const Point& target, double feed);
/// The machine's coordinates of a place of the program; axes that do not leave theirs keep it exactly.
Point machine_target(const Offsets& offsets, const Standing& from, const Point& program);
Point machine_target(const State& state, const Point& program);

/// G73 and G81 to G89; `motion` is the G code's number times ten.
constexpr bool is_cycle(int motion) { return motion == 730 || (motion > 800 && motion < 900); }

}  // namespace lockstep::gcode
