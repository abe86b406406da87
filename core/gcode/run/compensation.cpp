// G40 G41 G42 G41.1 G42.1: cutter compensation on and off.
#include "core/gcode/run/compensation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lockstep::gcode {
namespace {

/// From the tool's centre to the reference place of a lathe tool's offset, by orientation, in tool radii: along Z and
/// along X.
constexpr std::array<Flat, 10> kTips{
    {{0, 0}, {1, -1}, {-1, -1}, {-1, 1}, {1, 1}, {1, 0}, {0, -1}, {-1, 0}, {0, 1}, {0, 0}}};

struct Cutter {
    double radius = 0;  // below 0: on the other side
    int orientation = 0;
};

/// G41.1 and G42.1: D is the diameter, L the orientation.
std::expected<Cutter, GcodeError> cutter_of_words(const Context& context) {
    const LineWords& block = context.block;
    if (!block.has('D')) { return context.refuse(Group::Compensation, " needs D, the tool's diameter; write it"); }
    Cutter cutter{.radius = context.length(block['D']) / 2};
    if (!block.has('L')) { return cutter; }
    const auto orientation = whole(block['L']);
    if (!orientation || *orientation < 0 || *orientation >= static_cast<int>(kTips.size())) {
        return context.refuse('L', " is not a tool's orientation; it must be a whole number from 0 to 9");
    }
    if (context.state.modal.plane != Plane::ZX) {
        return context.refuse('L', " is the orientation of a lathe tool, which cuts in the plane of G18; write G18");
    }
    cutter.orientation = *orientation;
    return cutter;
}

/// G41 and G42: D is a tool of the table; without D, or with D0, it is the tool in the spindle.
std::expected<Cutter, GcodeError> cutter_of_table(const Context& context) {
    const LineWords& block = context.block;
    const auto named = whole(block.find('D').value_or(0));
    if (!named || *named < 0) {
        return context.refuse('D', " is not a tool's number; it must be a whole number from 0");
    }
    const State& state = context.state;
    const auto found = state.tools.find(*named == 0 ? state.tool : *named);
    if (found == state.tools.end()) {
        if (*named == 0) { return Cutter{}; }
        return context.refuse('D', ": tool " + std::to_string(*named) +
                                       " is not in the tool table; add it, or write G41.1 and D with the diameter");
    }
    if (found->second.orientation != 0 && state.modal.plane != Plane::ZX) {
        return context.refuse(Group::Compensation, " uses a lathe tool, which cuts in the plane of G18; write G18");
    }
    return Cutter{found->second.diameter / 2, found->second.orientation};
}

Result turn_on(Context& context, int code) {
    State& state = context.state;
    if (state.modal.plane == Plane::YZ) {
        return context.refuse(Group::Compensation,
                              " is not possible in the plane of Y and Z; write G17 or G18 before it");
    }
    if (context.is_compensated()) {
        return context.refuse(Group::Compensation,
                              " is not possible while cutter compensation is on; write G40 before it");
    }
    const bool by_words = code == 411 || code == 421;
    const auto cutter = by_words ? cutter_of_words(context) : cutter_of_table(context);
    if (!cutter) { return std::unexpected(cutter.error()); }
    const bool is_left = (code < 420) == (cutter->radius >= 0);
    state.modal.side = is_left ? Side::Left : Side::Right;
    state.modal.tool_radius = std::abs(cutter->radius);
    const Flat tip = kTips[static_cast<std::size_t>(std::clamp(cutter->orientation, 0, 9))];
    state.cutter.entered = false;
    state.cutter.tip = tip * state.modal.tool_radius;
    return {};
}

}  // namespace

Result compensation(Context& context) {
    const int code = context.block.code(Group::Compensation);
    if (code == LineWords::kNoCode) { return {}; }
    if (code != 400) { return turn_on(context, code); }
    leave_compensation(context);
    return {};
}

}  // namespace lockstep::gcode
