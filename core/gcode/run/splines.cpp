// G5 cubic and G5.1 quadratic splines, and G5.2 to G5.3 NURBS, in the plane of X and Y.
#include <utility>

#include "core/gcode/run/compensation.hpp"
#include "core/gcode/run/steps.hpp"

namespace lockstep::gcode {
namespace {

Result check_spline(const Context& context) {
    if (context.state.modal.plane != Plane::XY) {
        return context.refuse_motion(" is in the plane of X and Y; write G17 before it");
    }
    if (context.is_compensated()) {
        return context.refuse_motion(" is not possible while cutter compensation is on; write G40 before it");
    }
    if (context.state.cutter.stands) { return context.refuse_motion(kStraightAfterCompensation); }
    for (const char letter : std::string_view("ZABCUVW")) {
        if (context.block.has(letter)) {
            return context.refuse(letter, " is not possible in a spline, which moves only X and Y");
        }
    }
    return check_feed(context);
}

Result check_has_end(const Context& context) {
    if (context.block.has('X') || context.block.has('Y')) { return {}; }
    return context.refuse_motion(" has no end; write X and Y");
}

Spline::Control control_at(const Context& context, Flat at, double weight = 1) {
    Point place = context.state.program;
    place[0] = at.x;
    place[1] = at.y;
    const Point machine = machine_target(context.state, place);
    return {{machine[0], machine[1], machine[2]}, weight};
}

Flat here(const Context& context) { return {context.state.program[0], context.state.program[1]}; }

Flat words(const Context& context, char x, char y) {
    return {context.length(context.block[x]), context.length(context.block[y])};
}

void emit_spline(Context& context, Spline spline, const Point& end) {
    State& state = context.state;
    spline.target = machine_target(state, end);
    spline.feed = feed_of(context, state.program, end);
    context.emit(spline);
    state.machine = spline.target;
    state.program = end;
}

}  // namespace

/// I J: from the start to the first control point; P Q: from the end to the second. A G5 behind a G5 continues
/// smoothly without I and J.
Result cubic_spline(Context& context) {
    const LineWords& block = context.block;
    if (auto checked = check_spline(context); !checked) { return checked; }
    if (auto checked = check_has_end(context); !checked) { return checked; }
    if (!block.has('P') || !block.has('Q')) {
        return context.refuse_motion(" needs P and Q, its direction at the end; write both");
    }
    if (block.has('I') != block.has('J')) { return context.refuse_motion(" needs I and J, or neither; write both"); }
    std::optional<Flat>& direction = context.state.spline.direction;
    const bool goes_on = context.state.modal.motion == 50 && direction;
    if (!block.has('I') && !goes_on) { return context.refuse_motion(" has no direction at the start; write I and J"); }
    const Flat first = block.has('I') ? words(context, 'I', 'J') : Flat{} - *direction;
    const Flat last = words(context, 'P', 'Q');
    const Point end = context.target();
    const Flat to{end[0], end[1]};
    Spline spline{.target = {}, .order = 4, .controls = {}};
    for (const Flat at : {here(context), here(context) + first, to + last, to}) {
        spline.controls.push_back(control_at(context, at));
    }
    direction = last;
    emit_spline(context, std::move(spline), end);
    return {};
}

/// I J: from the start to the control point.
Result quadratic_spline(Context& context) {
    const LineWords& block = context.block;
    if (auto checked = check_spline(context); !checked) { return checked; }
    if (auto checked = check_has_end(context); !checked) { return checked; }
    if (!block.has('I') || !block.has('J')) {
        return context.refuse_motion(" needs I and J, its control point; write both");
    }
    const Point end = context.target();
    Spline spline{.target = {}, .order = 3, .controls = {}};
    for (const Flat at : {here(context), here(context) + words(context, 'I', 'J'), Flat{end[0], end[1]}}) {
        spline.controls.push_back(control_at(context, at));
    }
    emit_spline(context, std::move(spline), end);
    return {};
}

namespace {

constexpr std::size_t kMostControls = 5'000;

Result begin_nurbs(Context& context) {
    SplineWords& words = context.state.spline;
    const auto order = context.block.has('L') ? whole(context.block['L']) : std::optional(3);
    if (!order || *order < 2 || *order > kMaxSplineOrder) {
        return context.refuse('L', " is not the order of a NURBS; it must be a whole number from 2 to " +
                                       std::to_string(kMaxSplineOrder));
    }
    words.nurbs = Spline{.target = {}, .order = *order, .controls = {control_at(context, here(context))}};
    words.end = context.state.program;
    return {};
}

Result end_nurbs(Context& context) {
    SplineWords& words = context.state.spline;
    if (!words.nurbs) { return context.refuse_motion(" ends a NURBS that did not begin; write G5.2 before it"); }
    Spline spline = *std::exchange(words.nurbs, std::nullopt);
    if (spline.controls.size() < static_cast<std::size_t>(spline.order)) {
        return context.refuse_motion(" ends a NURBS of " + std::to_string(spline.controls.size()) +
                                     " points; its order needs at least " + std::to_string(spline.order));
    }
    emit_spline(context, std::move(spline), words.end);
    context.motion = kNoMotion;
    return {};
}

}  // namespace

/// G5.2 and the blocks behind it give control points, X and Y with the weight P; G5.3 ends the curve.
Result nurbs(Context& context) {
    if (context.motion == 53) { return end_nurbs(context); }
    const LineWords& block = context.block;
    if (auto checked = check_spline(context); !checked) { return checked; }
    if (block.has(Group::Motion) || !context.state.spline.nurbs) {
        if (auto begun = begin_nurbs(context); !begun) { return begun; }
    }
    if (!block.has('X') && !block.has('Y') && block.has(Group::Motion)) { return {}; }
    if (!block.has('X') || !block.has('Y')) {
        return context.refuse_motion(" needs both X and Y of each point; write them");
    }
    const double weight = block.find('P').value_or(block.has(Group::Motion) ? 1 : 0);
    if (!(weight > 0)) { return context.refuse_motion(" needs the weight of each point; write P, above 0"); }
    SplineWords& words = context.state.spline;
    if (words.nurbs->controls.size() >= kMostControls) {
        return context.refuse_motion(" has more than " + std::to_string(kMostControls) +
                                     " points; divide the curve with G5.3");
    }
    const Point end = context.target();  // in G91 relative to the begin of the curve
    words.end = end;
    words.nurbs->controls.push_back(control_at(context, {end[0], end[1]}, weight));
    return {};
}

}  // namespace lockstep::gcode
