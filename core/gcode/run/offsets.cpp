// Coordinate systems and offsets: G10 L2 L20, G52 to G59.3, G92.
#include <cmath>

#include "core/gcode/run/steps.hpp"

namespace lockstep::gcode {
namespace {

void store_g92(State& state) {
    set_place(state.parameters, kG92Parameter, state.offsets.g92);
    state.parameters.numbered[kG92UsedParameter] = 1;
}

/// G92: gives these coordinates to the place where the axes stand.
Result name_place(Context& context) {
    if (!context.block.has_axes()) {
        return context.refuse(Group::NonModal,
                              " sets no axis; write the axes and what they now read, or G92.1 to clear");
    }
    State& state = context.state;
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
        const auto word = context.axis_word(axis);
        if (!word) { continue; }
        state.offsets.g92[axis] += state.program[axis] - *word;
        state.program[axis] = *word;
    }
    store_g92(state);
    return {};
}

/// G52: sets the offsets themselves.
Result shift(Context& context) {
    if (!context.block.has_axes()) {
        return context.refuse(Group::NonModal, " shifts no axis; write the axes and by how much");
    }
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
        if (const auto word = context.axis_word(axis)) { context.state.offsets.g92[axis] = *word; }
    }
    store_g92(context.state);
    offsets_changed(context);
    return {};
}

/// G92.1 clears the offsets, G92.2 keeps them in the parameters only, G92.3 restores them from there.
Result clear_or_restore(Context& context, int code) {
    State& state = context.state;
    state.offsets.g92 = code == 923 ? place_of(state.parameters, kG92Parameter) : Point{};
    if (code == 921) { set_place(state.parameters, kG92Parameter, {}); }
    state.parameters.numbered[kG92UsedParameter] = code == 923 ? 1 : 0;
    offsets_changed(context);
    return {};
}

std::expected<std::size_t, GcodeError> system_of(const Context& context) {
    const auto number = context.block.has('P') ? whole(context.block['P']) : std::nullopt;
    if (!number || *number < 0 || *number > static_cast<int>(kSystems)) {
        return context.refuse(Group::NonModal,
                              " names no coordinate system; write P and 1 to 9, or P0 for the one in use");
    }
    return *number == 0 ? context.state.modal.system : static_cast<std::size_t>(*number) - 1;
}

/// L20: the origin with which the axis's place reads as the word says. The other axes keep their places in that system.
/// If X and Y are rotated, both change together.
void origin_by_place(const Context& context, std::size_t system, Point& origin) {
    const State& state = context.state;
    Offsets offsets = state.offsets;
    offsets.origin = origin;
    offsets.rotation = state.parameters.numbered[static_cast<std::size_t>(origin_parameter(system)) + kAxes];
    Point wanted = to_program(offsets, state.machine);
    for (std::size_t axis = 0; axis < kAxes; ++axis) { wanted[axis] = context.axis_word(axis).value_or(wanted[axis]); }
    offsets.origin = {};
    const Point without = to_machine(offsets, wanted);
    const bool both = offsets.rotation != 0 && (context.block.has('X') || context.block.has('Y'));
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
        if (context.axis_word(axis) || (both && axis < 2)) { origin[axis] = state.machine[axis] - without[axis]; }
    }
}

}  // namespace

void offsets_changed(Context& context) {
    context.state.program = to_program(context.state.offsets, context.state.machine);
}

Result set_system(Context& context) {
    const LineWords& block = context.block;
    const auto system = system_of(context);
    if (!system) { return std::unexpected(system.error()); }
    const bool by_place = whole(block['L']) == 20;
    for (const char letter : {'I', 'J'}) {
        if (block.has(letter)) { return context.refuse(letter, " is an angle of a tool (G10 L1); remove it"); }
    }
    if (by_place && block.has('R')) { return context.refuse('R', " is not possible with L20; set a rotation with L2"); }
    if (by_place && context.is_compensated()) {
        return context.refuse(Group::NonModal,
                              " L20 sets a zero from the axes' positions, which cutter compensation changes; write G40 "
                              "and a motion before it");
    }
    if (context.is_compensated() && *system == context.state.modal.system) {
        return context.refuse(Group::NonModal,
                              " changes the offsets in use while cutter compensation is on; write G40 before it");
    }
    ParameterValues& parameters = context.state.parameters;
    const int first = origin_parameter(*system);
    Point origin = place_of(parameters, first);
    for (std::size_t axis = 0; axis < kAxes && !by_place; ++axis) {
        origin[axis] = context.axis_word(axis).value_or(origin[axis]);
    }
    if (by_place) { origin_by_place(context, *system, origin); }
    set_place(parameters, first, origin);
    if (block.has('R')) { parameters.numbered[static_cast<std::size_t>(first) + kAxes] = block['R']; }
    if (*system == context.state.modal.system) { begin_system(context.state, *system); }
    return {};
}

Result choose_system(Context& context) {
    const int code = context.block.code(Group::System);
    if (code == LineWords::kNoCode) { return {}; }
    const auto system = static_cast<std::size_t>(code <= 590 ? (code - 540) / 10 : 5 + code - 590);
    if (auto checked = context.refuse_compensated(Group::System); !checked) { return checked; }
    if (system != context.state.modal.system) { begin_system(context.state, system); }
    return {};
}

Result offset_axes(Context& context) {
    const int code = context.block.code(Group::NonModal);
    if (auto checked = context.refuse_compensated(Group::NonModal); !checked) { return checked; }
    if (code == 520) { return shift(context); }
    return code == 920 ? name_place(context) : clear_or_restore(context, code);
}

Result non_modal(Context& context) {
    switch (context.block.code(Group::NonModal)) {
        case 100: {
            const auto kind = context.block.has('L') ? whole(context.block['L']) : std::nullopt;
            if (kind == 2 || kind == 20) { return set_system(context); }
            if (kind == 1 || kind == 10 || kind == 11) { return set_tool(context); }
            return context.refuse(Group::NonModal,
                                  " does not say what it sets; write L2 or L20 for a coordinate system, "
                                  "L1, L10 or L11 for a tool");
        }
        case 280:
        case 281:
        case 300:
        case 301: return go_home(context);
        case 520:
        case 920:
        case 921:
        case 922:
        case 923: return offset_axes(context);
        default: return {};
    }
}

}  // namespace lockstep::gcode
