// G28 and G30: move through the block's point to a place that is stored in parameters. G28.1 and G30.1 store it.
#include "core/gcode/run/steps.hpp"

namespace lockstep::gcode {
namespace {

/// If X and Y are rotated, X alone moves along the rotated X, and Y keeps its place in the program's coordinates.
Point turned_home(const Context& context, const Point& home) {
    const State& state = context.state;
    Point target = to_program(state.offsets, home);
    for (const std::size_t axis : {0U, 1U}) {
        if (!context.block.has(kAxisLetters[axis])) { target[axis] = state.program[axis]; }
    }
    return to_machine(state.offsets, target);
}

}  // namespace

Result go_home(Context& context) {
    State& state = context.state;
    const int code = context.block.code(Group::NonModal);
    const int first = code < 300 ? kHomeParameter : kSecondHomeParameter;
    if (auto checked = context.refuse_compensated(Group::NonModal); !checked) { return checked; }
    if (code == 281 || code == 301) {
        set_place(state.parameters, first, state.machine);
        return {};
    }
    move(context, context.target(), 0);
    Point machine = state.machine;
    Point home = place_of(state.parameters, first);
    if (state.offsets.rotation != 0 && context.block.has_axes()) { home = turned_home(context, home); }
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
        const bool turned = axis < 2 && state.offsets.rotation != 0 && context.block.has_any("XY");
        const bool named = context.block.has(kAxisLetters[axis]) || !context.block.has_axes() || turned;
        const bool exists = context.setup.axes.contains(kAxisLetters[axis]);
        if (named && exists) { machine[axis] = home[axis]; }
    }
    if (machine != state.machine) { context.emit(Straight{machine, 0, true}); }
    state.machine = machine;
    offsets_changed(context);
    return {};
}

}  // namespace lockstep::gcode
