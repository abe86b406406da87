// G28 and G30: through the point that the block names to a place kept in parameters; G28.1 and G30.1 keep it.
#include "core/gcode/run/steps.hpp"

namespace lockstep::gcode {

Result go_home(Context& context) {
    State& state = context.state;
    const int code = context.block.code(Group::NonModal);
    const int first = code < 300 ? kHomeParameter : kSecondHomeParameter;
    if (code == 281 || code == 301) {
        set_place(state.parameters, first, state.machine);
        return {};
    }
    if (state.modal.side != Side::None) {
        return context.refuse(Group::NonModal, " while cutter compensation is on; write G40 before it");
    }
    move(context, context.target(), 0);
    Point machine = state.machine;
    const Point home = place_of(state.parameters, first);
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
        const bool named = context.block.has(kAxisLetters[axis]) || !context.block.has_axes();
        const bool exists = context.setup.axes.contains(kAxisLetters[axis]);
        if (named && exists) { machine[axis] = home[axis]; }
    }
    if (machine != state.machine) { context.emit(Straight{machine, 0, true}); }
    state.machine = machine;
    offsets_changed(context);
    return {};
}

}  // namespace lockstep::gcode
