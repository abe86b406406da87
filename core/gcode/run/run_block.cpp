#include <array>
#include <cmath>

#include "core/gcode/run/steps.hpp"
#include "core/gcode/text/functions.hpp"

namespace lockstep::gcode {
namespace {

using Step = Result (*)(Context&);

/// RS274's order, except for the units: they come before F, which is in the units of its own block.
constexpr std::array kSteps{
    choose_motion, check_letters, set_units,    comment,     set_feed_mode, set_feed,      spindle_speed,
    select_tool,   outputs,       change_tool,  spindle,     keep_state,    coolant,       overrides,
    dwell,         set_plane,     compensation, tool_length, choose_system, set_path_mode, set_distance_modes,
    non_modal,     run_motion,    stop,
};

/// A block with only a straight motion, axes and F needs few steps.
constexpr std::array kPlainSteps{set_feed, run_motion};

bool is_plain(const Context& context) {
    const LineWords& block = context.block;
    if (block.comment || block.distance || block.angle || block.has_any("DEHIJKLPQRST")) { return false; }
    const int motion = block.code(Group::Motion);
    const bool is_straight = motion == 0 || motion == 10;
    if (!is_straight || !block.has_axes()) { return false; }
    for (std::size_t group = 0; group < kGroups; ++group) {
        if (static_cast<Group>(group) != Group::Motion && block.has(static_cast<Group>(group))) { return false; }
    }
    return true;
}

template <typename Steps>
Result run_all(Context& context, const Steps& steps) {
    for (const Step step : steps) {
        if (auto done = step(context); !done) { return done; }
    }
    return {};
}

/// @ and ^: the distance from the program's zero and the angle from X become X and Y. In G91 they are added to those of
/// the place where the axes stand.
Result resolve_polar(Context& context) {
    LineWords& block = context.block;
    if (!block.distance && !block.angle) { return {}; }
    if (block.has('X') || block.has('Y')) {
        return context.refuse(block.has('X') ? 'X' : 'Y',
                              " is in the same block as @ or ^, which give X and Y; write one or the other");
    }
    if (block.code(Group::NonModal) == 530) {
        return context.refuse(Group::NonModal, " is not possible with @ or ^; write X and Y");
    }
    if (context.state.modal.plane != Plane::XY) {
        return std::unexpected(context.line.error(0, "@ and ^ are in the plane of X and Y; write G17 before them"));
    }
    const Point& at = context.state.program;
    const double unit = context.length(1);
    const double before = std::hypot(at[0], at[1]) / unit;
    const double before_degrees = std::atan2(at[1], at[0]) * kDegrees;
    const bool relative =
        block.has(Group::Distance) ? block.code(Group::Distance) == 910 : context.state.modal.relative;
    if (before == 0 && relative) {
        return std::unexpected(
            context.line.error(0, "@ or ^ in G91 at the program's zero has no direction; write G90"));
    }
    if (before == 0 && !block.angle) {
        return std::unexpected(context.line.error(0, "@ without ^ at the program's zero has no direction; write ^"));
    }
    const double distance = block.distance ? *block.distance + (relative ? before : 0) : before;
    const double degrees = block.angle ? *block.angle + (relative ? before_degrees : 0) : before_degrees;
    const double x = distance * std::cos(degrees / kDegrees);
    const double y = distance * std::sin(degrees / kDegrees);
    block.set('X', relative ? x - at[0] / unit : x, 0);
    block.set('Y', relative ? y - at[1] / unit : y, 0);
    return {};
}

}  // namespace

Result run_block(Context& context) {
    if (auto resolved = resolve_polar(context); !resolved) { return resolved; }
    if (is_plain(context)) {
        context.motion = context.block.code(Group::Motion);
        return run_all(context, kPlainSteps);
    }
    return run_all(context, kSteps);
}

}  // namespace lockstep::gcode
