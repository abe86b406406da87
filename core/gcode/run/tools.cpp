// Tools: T, M6, M61, the tool table (G10 L1 L10 L11) and tool length offsets (G43 G49).
#include "core/gcode/run/steps.hpp"

namespace lockstep::gcode {
namespace {

std::string no_tool(int tool) {
    return ": tool " + std::to_string(tool) + " is not in the tool table; add it, or remove the word";
}

/// G43: the offset of the tool in the spindle, or of the tool that H names.
std::expected<Point, GcodeError> tool_offset(const Context& context) {
    const LineWords& block = context.block;
    int tool = context.state.tool;
    if (block.has('H')) {
        const auto named = whole(block['H']);
        if (!named || *named < 0) {
            return context.refuse('H', " is not a tool's number; it must be a whole number from 0");
        }
        tool = *named;
    }
    if (tool == 0) { return Point{}; }
    const auto found = context.state.tools.find(tool);
    if (found != context.state.tools.end()) { return found->second.offset; }
    if (block.has('H')) { return context.refuse('H', no_tool(tool)); }
    return context.refuse(Group::ToolLength, no_tool(tool));
}

/// Without a tool table any tool may be used; its offset is unknown.
bool is_known(const State& state, int tool) { return tool == 0 || state.tools.empty() || state.tools.contains(tool); }

void set_words(const Context& context, Point& offset) {
    for (std::size_t axis = 0; axis < kAxes; ++axis) { offset[axis] = context.axis_word(axis).value_or(offset[axis]); }
}

/// G43.2: adds to the offset in use.
Result add_offset(Context& context) {
    const LineWords& block = context.block;
    if (block.has('H') && block.has_axes()) {
        return context.refuse('H', " is in the same block as axis words; write one or the other");
    }
    if (block.has('H')) {
        const auto added = tool_offset(context);
        if (!added) { return std::unexpected(added.error()); }
        for (std::size_t axis = 0; axis < kAxes; ++axis) { context.state.offsets.tool[axis] += (*added)[axis]; }
        return {};
    }
    if (!block.has_axes()) {
        return context.refuse(Group::ToolLength, " adds nothing; write H and a tool, or axis words");
    }
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
        context.state.offsets.tool[axis] += context.axis_word(axis).value_or(0);
    }
    return {};
}

/// The offset with which the place where the tool stands reads as the words say. L11: without the G92 offsets, from the
/// origin of the ninth coordinate system.
void measure(const Context& context, bool by_fixture, Point& offset) {
    const State& state = context.state;
    Offsets offsets = state.offsets;
    offsets.tool = {};
    if (by_fixture) {
        const int first = origin_parameter(kSystems - 1);
        offsets.g92 = {};
        offsets.origin = place_of(state.parameters, first);
        offsets.rotation = state.parameters.numbered[static_cast<std::size_t>(first) + kAxes];
    }
    Point wanted = to_program(offsets, state.machine);
    set_words(context, wanted);
    const Point without = to_machine(offsets, wanted);
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
        if (context.axis_word(axis)) { offset[axis] = state.machine[axis] - without[axis]; }
    }
}

}  // namespace

Result select_tool(Context& context) {
    const auto number = context.block.find('T');
    if (!number) { return {}; }
    const auto tool = whole(*number);
    if (!tool || *tool < 0) { return context.refuse('T', " is not a tool's number; it must be a whole number from 0"); }
    if (!is_known(context.state, *tool)) { return context.refuse('T', no_tool(*tool)); }
    context.state.selected_tool = *tool;
    context.event(EventKind::ToolSelect, *tool);
    return {};
}

Result change_tool(Context& context) {
    State& state = context.state;
    const int code = context.block.code(Group::Tool);
    if (code == LineWords::kNoCode) { return {}; }
    if (auto checked = context.refuse_compensated(Group::Tool); !checked) { return checked; }
    if (code == 60) {
        state.tool = state.selected_tool;
        state.modal.spindle = SpindleDirection::Stopped;
        context.event(EventKind::SpindleStop);
        context.event(EventKind::ToolChange, state.tool);
        return {};
    }
    const auto tool = context.block.has('Q') ? whole(context.block['Q']) : std::nullopt;
    if (!tool || *tool < 0) { return context.refuse(Group::Tool, " names no tool; write Q and its number, from 0"); }
    if (!is_known(state, *tool)) { return context.refuse('Q', no_tool(*tool)); }
    state.tool = *tool;
    context.event(EventKind::ToolNumber, *tool);
    return {};
}

Result tool_length(Context& context) {
    const int code = context.block.code(Group::ToolLength);
    if (code == LineWords::kNoCode) { return {}; }
    if (auto checked = context.refuse_compensated(Group::ToolLength); !checked) { return checked; }
    Point& offset = context.state.offsets.tool;
    if (code == 490) { offset = {}; }
    if (code == 430) {
        const auto chosen = tool_offset(context);
        if (!chosen) { return std::unexpected(chosen.error()); }
        offset = *chosen;
    }
    if (code == 431) { set_words(context, offset); }
    if (code == 432) {
        if (auto added = add_offset(context); !added) { return added; }
    }
    offsets_changed(context);
    return {};
}

Result set_tool(Context& context) {
    const LineWords& block = context.block;
    const int kind = whole(block['L']).value_or(0);
    const auto number = block.has('P') ? whole(block['P']) : std::nullopt;
    if (!number || *number < 1) {
        return context.refuse(Group::NonModal, " names no tool; write P and its number, from 1");
    }
    const auto found = context.state.tools.find(*number);
    if (found == context.state.tools.end()) { return context.refuse('P', no_tool(*number)); }
    Tool& tool = found->second;
    if (kind == 1) {
        set_words(context, tool.offset);
    } else {
        measure(context, kind == 11, tool.offset);
    }
    if (block.has('R')) { tool.diameter = 2 * context.length(block['R']); }
    tool.front_angle = block.find('I').value_or(tool.front_angle);
    tool.back_angle = block.find('J').value_or(tool.back_angle);
    if (block.has('Q')) {
        const auto orientation = whole(block['Q']);
        if (!orientation || *orientation < 0 || *orientation > 9) {
            return context.refuse('Q', " is not a tool's orientation; it must be a whole number from 0 to 9");
        }
        tool.orientation = *orientation;
    }
    return {};
}

}  // namespace lockstep::gcode
