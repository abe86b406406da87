// Units, feed, plane, path and distance modes.
#include "core/gcode/run/steps.hpp"

namespace lockstep::gcode {

Result set_units(Context& context) {
    const int code = context.block.code(Group::Units);
    if (code != LineWords::kNoCode) { context.state.modal.inches = code == 200; }
    return {};
}

/// G94 clears the feed, as in LinuxCNC: the next motion needs an F.
Result set_feed_mode(Context& context) {
    Modal& modal = context.state.modal;
    switch (context.block.code(Group::FeedMode)) {
        case 930: modal.feed_mode = FeedMode::InverseTime; break;
        case 940:
            modal.feed_mode = FeedMode::PerMinute;
            modal.feed_linear = modal.feed_turning = 0;
            break;
        default: break;
    }
    return {};
}

/// With inverse time, F applies to its own block only: see feed_of.
Result set_feed(Context& context) {
    const auto feed = context.block.find('F');
    if (!feed) { return {}; }
    if (*feed < 0) { return context.refuse('F', " is not a feed; F is per minute and must be above 0"); }
    Modal& modal = context.state.modal;
    if (modal.feed_mode == FeedMode::PerMinute) {
        modal.feed_linear = context.length(*feed);
        modal.feed_turning = *feed;
    }
    return {};
}

Result set_plane(Context& context) {
    const int code = context.block.code(Group::Plane);
    if (code == LineWords::kNoCode) { return {}; }
    const Plane plane = code == 170 ? Plane::XY : code == 180 ? Plane::ZX : Plane::YZ;
    if (context.is_compensated() && plane != context.state.modal.plane) {
        return context.refuse(Group::Plane, " is not possible while cutter compensation is on; write G40 before it");
    }
    context.state.modal.plane = plane;
    return {};
}

Result set_path_mode(Context& context) {
    const int code = context.block.code(Group::PathMode);
    if (code == LineWords::kNoCode) { return {}; }
    if (auto checked = context.refuse_compensated(Group::PathMode); !checked) { return checked; }
    Modal& modal = context.state.modal;
    modal.path_mode = code;
    modal.path_tolerance = code == 640 ? context.length(context.block.find('P').value_or(0)) : 0;
    context.event(EventKind::PathMode, code, modal.path_tolerance);
    return {};
}

Result set_distance_modes(Context& context) {
    Modal& modal = context.state.modal;
    const LineWords& block = context.block;
    if (block.has(Group::Distance)) { modal.relative = block.code(Group::Distance) == 910; }
    if (block.has(Group::CentreDistance)) { modal.centres_absolute = block.code(Group::CentreDistance) == 901; }
    if (block.has(Group::Retract)) { modal.retract_to_start = block.code(Group::Retract) == 980; }
    return {};
}

}  // namespace lockstep::gcode
