// Straight moves, and the call of a block's motion.
#include <cmath>

#include "core/gcode/run/compensation.hpp"
#include "core/gcode/run/steps.hpp"

namespace lockstep::gcode {
namespace {

constexpr int kCancel = 800;

/// G53: the block's axis words are machine coordinates.
Point machine_words(const Context& context) {
    Point machine = context.state.machine;
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
        if (const auto word = context.axis_word(axis)) { machine[axis] = *word; }
    }
    return to_program(context.state.offsets, machine);
}

Result check_machine_coordinates(const Context& context) {
    if (context.motion != 0 && context.motion != 10) {
        return context.refuse(Group::NonModal, " needs G0 or G1 in its block or before it");
    }
    if (context.state.modal.relative) {
        return context.refuse(Group::NonModal, " uses machine coordinates, which are absolute; write G90 before it");
    }
    return context.refuse_compensated(Group::NonModal);
}

double norm(const Point& from, const Point& to, std::size_t first, std::size_t last) {
    double square = 0;
    for (std::size_t axis = first; axis < last; ++axis) { square += (to[axis] - from[axis]) * (to[axis] - from[axis]); }
    return std::sqrt(square);
}

}  // namespace

Result check_feed(const Context& context) {
    const Modal& modal = context.state.modal;
    if (modal.feed_mode == FeedMode::InverseTime) {
        if (context.block.find('F').value_or(0) > 0) { return {}; }
        return context.refuse_motion(" needs F in inverse time (G93); write F as 1 divided by the minutes of the move");
    }
    if (modal.feed_linear > 0) { return {}; }
    if (context.block.has('F')) { return context.refuse('F', " is not a feed; F is per minute and must be above 0"); }
    auto error = context.refuse_motion(" has no feed; write F, per minute, here or before");
    error.error().repeats = true;
    return error;
}

double feed_of(const Context& context, const Point& from, const Point& to, std::optional<double> path) {
    const Modal& modal = context.state.modal;
    const double xyz = path.value_or(norm(from, to, 0, 3));
    const double linear = xyz > 0 ? xyz : norm(from, to, 6, 9);
    if (modal.feed_mode == FeedMode::PerMinute) { return linear > 0 ? modal.feed_linear : modal.feed_turning; }
    return context.block['F'] * (linear > 0 ? linear : norm(from, to, 3, 6));
}

Point machine_target(const Offsets& offsets, const Standing& from, const Point& program) {
    Point result = to_machine(offsets, program);
    const bool turned = offsets.rotation != 0;
    const bool leaves_xy = program[0] != from.program[0] || program[1] != from.program[1];
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
        const bool leaves = turned && axis < 2 ? leaves_xy : program[axis] != from.program[axis];
        if (!leaves) { result[axis] = from.machine[axis]; }
    }
    return result;
}

Point machine_target(const State& state, const Point& program) {
    return machine_target(state.offsets, {state.program, state.machine}, program);
}

/// The first move after cutter compensation begins at the tool's centre.
void move(Context& context, const Point& target, double feed) {
    State& state = context.state;
    const Point machine = machine_target(state, target);
    const Point& from = state.cutter.stands ? state.cutter.stands->machine : state.machine;
    if (machine != from) { context.emit(Straight{machine, feed, feed == 0}); }
    state.cutter.stands.reset();
    state.machine = machine;
    state.program = target;
}

namespace {

/// The motion that leads back from cutter compensation also moves the plane's axes. So its feed is computed from where
/// the axes stand.
const Point& start_of_feed(const State& state) {
    const bool leads_back = state.cutter.stands && state.modal.feed_mode == FeedMode::PerMinute;
    return leads_back ? state.cutter.stands->program : state.program;
}

}  // namespace

Result straight(Context& context) {
    Point target;
    if (context.block.code(Group::NonModal) == 530) {
        if (auto checked = check_machine_coordinates(context); !checked) { return checked; }
        target = machine_words(context);
    } else {
        target = context.target();
    }
    const bool rapid = context.motion == 0;
    if (!rapid) {
        if (auto checked = check_feed(context); !checked) { return checked; }
    }
    if (is_offset(context.state)) { return compensated_straight(context, target, rapid); }
    move(context, target, rapid ? 0 : feed_of(context, start_of_feed(context.state), target));
    return {};
}

Result run_motion(Context& context) {
    Modal& modal = context.state.modal;
    if (context.block.code(Group::Motion) == kCancel) { modal.motion = kNoMotion; }
    const int motion = context.motion;
    if (motion == kNoMotion) {
        if (context.block.code(Group::NonModal) == 530) { return check_machine_coordinates(context); }
        return {};
    }
    if (context.block.code(Group::NonModal) == 530 && motion != 0 && motion != 10) {
        return check_machine_coordinates(context);
    }
    Result done;
    switch (motion) {
        case 0:
        case 10: done = straight(context); break;
        case 20:
        case 30: done = arc(context); break;
        case 50: done = cubic_spline(context); break;
        case 51: done = quadratic_spline(context); break;
        case 52:
        case 53: done = nurbs(context); break;
        default:
            if (is_cycle(motion)) { done = canned_cycle(context); }
            if (is_probing(motion)) { done = probe(context); }
    }
    modal.motion = motion;
    return done;
}

}  // namespace lockstep::gcode
