// G2 and G3: arcs by centre or by radius, in each plane, with turns and a rise.
#include <cmath>

#include "core/arc_path.hpp"
#include "core/gcode/run/arc_geometry.hpp"
#include "core/gcode/run/compensation.hpp"
#include "core/gcode/run/steps.hpp"
#include "core/number_text.hpp"

namespace lockstep::gcode {
namespace {

// LinuxCNC's tolerance: the radius of an R arc may be too small for its chord by this much.
constexpr double kChordError_mm = 0.00127;
constexpr double kLeastRadius_mm = 1e-6;
// LinuxCNC's tolerances of centres: the greatest rounding of centres and ends to 0.01 mm or 0.001 inches.
constexpr ArcTolerance kInMillimetres{
    .least_radius_mm = kChordError_mm, .error_mm = 0.02 * std::numbers::sqrt2, .share = 0.001};
constexpr ArcTolerance kInInches{
    .least_radius_mm = kChordError_mm, .error_mm = 0.002 * std::numbers::sqrt2 * 25.4, .share = 0.001};

constexpr char letter_of(std::size_t axis) { return "IJK"[axis]; }

std::string in_mm(double value) { return number_text(value) + " mm"; }

std::expected<int, GcodeError> turns_of(const Context& context) {
    if (!context.block.has('P')) { return 1; }
    const auto turns = whole(context.block['P']);
    if (!turns || *turns < 1 || *turns > kMaxTurns) {
        return context.refuse(
            'P', " is not a number of turns; it must be a whole number from 1 to " + std::to_string(kMaxTurns));
    }
    return *turns;
}

/// The centre by R: the arc is less than half a turn if R is above 0, otherwise more.
std::expected<Flat, GcodeError> centre_by_radius(const Context& context, Flat from, Flat to) {
    const double radius = context.length(context.block['R']);
    const Flat chord = to - from;
    const double half = length_of(chord) / 2;
    if (half < kLeastRadius_mm) {
        return context.refuse('R', " with the end equal to the start: the centre is undefined; write I, J or K");
    }
    if (half - std::abs(radius) > kChordError_mm) {
        return context.refuse(
            'R', " is too small to reach the end, " + in_mm(2 * half) + " away; it must be at least " + in_mm(half));
    }
    const double height = std::sqrt(std::max(radius * radius - half * half, 0.0));
    const bool is_left = (context.motion == 30) == (radius > 0);
    const Flat aside = left_of(chord) * (height / (2 * half));
    const Flat middle = (from + to) * 0.5;
    return is_left ? middle + aside : middle - aside;
}

std::expected<Flat, GcodeError> centre_by_offsets(const Context& context, PlaneAxes axes, Flat from) {
    const LineWords& block = context.block;
    const char first = letter_of(axes.first);
    const char second = letter_of(axes.second);
    if (!block.has(first) && !block.has(second)) {
        return context.refuse_motion(std::string(" has no centre; write ") + first + " and " + second + ", or R");
    }
    if (!context.state.modal.centres_absolute) {
        return from +
               Flat{context.length(block.find(first).value_or(0)), context.length(block.find(second).value_or(0))};
    }
    for (const char letter : {first, second}) {
        if (!block.has(letter)) {
            return context.refuse_motion(std::string(" has no ") + letter +
                                         ", and centres are absolute (G90.1); write it");
        }
    }
    return Flat{context.length(block[first]), context.length(block[second])};
}

Result check_radii(const Context& context, Flat from, Flat centre, Flat to) {
    const ArcTolerance& tolerance = context.state.modal.inches ? kInInches : kInMillimetres;
    const std::string why = why_no_arc(length_of(from - centre), length_of(to - centre), tolerance);
    return why.empty() ? Result{} : context.refuse_motion(" " + why);
}

Result check_words(const Context& context, PlaneAxes axes) {
    const LineWords& block = context.block;
    const char normal = letter_of(axes.normal);
    if (block.has(normal)) {
        return context.refuse(normal, " is perpendicular to the arc's plane; choose the plane with G17, G18 or G19");
    }
    if (block.has('R') && block.has_any("IJK")) {
        return context.refuse('R', " is in the same block as I, J or K; write either the radius or the centre");
    }
    if (block.has('R') && !block.has(kAxisLetters[axes.first]) && !block.has(kAxisLetters[axes.second])) {
        return context.refuse('R', " needs an end in the arc's plane; write the end");
    }
    return {};
}

/// A feed per minute does not depend on the arc's length.
double feed_of_arc(const Context& context, PlaneAxes axes, const ArcMove& move) {
    const State& state = context.state;
    if (state.modal.feed_mode == FeedMode::PerMinute) { return state.modal.feed_linear; }
    const Flat from = in_plane(axes, state.program);
    const double radius = length_of(from - move.centre);
    const int turns = std::abs(move.turns);
    const double sweep = sweep_of(from, move.centre, in_plane(axes, move.target), move.turns > 0, turns);
    const double rise = move.target[axes.normal] - state.program[axes.normal];
    return feed_of(context, state.program, move.target, std::hypot(sweep * radius, rise));
}

}  // namespace

Vector turned_axis(const State& state, std::size_t normal) {
    Offsets turn;
    turn.rotation = state.offsets.rotation;
    Point axis{};
    axis[normal] = 1;
    axis = to_machine(turn, axis);
    return {axis[0], axis[1], axis[2]};
}

void move_arc(Context& context, const ArcMove& move) {
    State& state = context.state;
    const PlaneAxes axes = axes_of(state.modal.plane);
    Point centre = move.target;
    centre[axes.first] = move.centre.x;
    centre[axes.second] = move.centre.y;
    centre[axes.normal] = state.program[axes.normal];
    const Point at = to_machine(state.offsets, centre);
    const Point target = machine_target(state, move.target);
    context.emit(Arc{.target = target,
                     .centre = {at[0], at[1], at[2]},
                     .axis = turned_axis(state, axes.normal),
                     .turns = move.turns,
                     .feed = feed_of_arc(context, axes, move)});
    state.machine = target;
    state.program = move.target;
}

Result arc(Context& context) {
    if (auto checked = check_feed(context); !checked) { return checked; }
    if (context.state.cutter.stands && !context.is_compensated()) {
        return context.refuse_motion(kStraightAfterCompensation);
    }
    const PlaneAxes axes = axes_of(context.state.modal.plane);
    if (auto checked = check_words(context, axes); !checked) { return checked; }
    const auto turns = turns_of(context);
    if (!turns) { return std::unexpected(turns.error()); }
    ArcMove move{.target = context.target(), .centre = {}, .turns = context.motion == 30 ? *turns : -*turns};
    const Flat from = in_plane(axes, context.state.program);
    const Flat to = in_plane(axes, move.target);
    const bool has_radius = context.block.has('R');
    const auto centre = has_radius ? centre_by_radius(context, from, to) : centre_by_offsets(context, axes, from);
    if (!centre) { return std::unexpected(centre.error()); }
    move.centre = *centre;
    if (auto checked = check_radii(context, from, *centre, to); !has_radius && !checked) { return checked; }
    if (is_offset(context.state)) { return compensated_arc(context, move); }
    move_arc(context, move);
    return {};
}

}  // namespace lockstep::gcode
