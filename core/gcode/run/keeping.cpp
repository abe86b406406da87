// M70 to M73: storing the modes and restoring them.
#include "core/gcode/run/steps.hpp"

namespace lockstep::gcode {
namespace {

void restore_spindle(Context& context, const Modal& before) {
    const Modal& now = context.state.modal;
    if (now.spindle_speed != before.spindle_speed) { context.event(EventKind::SpindleSpeed, 0, now.spindle_speed); }
    if (now.spindle == before.spindle) { return; }
    context.event(now.spindle == SpindleDirection::Forward   ? EventKind::SpindleForward
                  : now.spindle == SpindleDirection::Reverse ? EventKind::SpindleReverse
                                                             : EventKind::SpindleStop);
}

void restore_coolant(Context& context, const Modal& before) {
    const Modal& now = context.state.modal;
    if (now.mist == before.mist && now.flood == before.flood) { return; }
    if ((before.mist && !now.mist) || (before.flood && !now.flood)) { context.event(EventKind::CoolantOff); }
    if (now.mist) { context.event(EventKind::Mist); }
    if (now.flood) { context.event(EventKind::Flood); }
}

void restore_switches(Context& context, const Modal& before) {
    const Modal& now = context.state.modal;
    const auto set = [&](bool Modal::*value, EventKind kind) {
        if (now.*value != before.*value) { context.event(kind, 0, now.*value ? 1 : 0); }
    };
    set(&Modal::feed_override, EventKind::FeedOverride);
    set(&Modal::speed_override, EventKind::SpeedOverride);
    set(&Modal::adaptive_feed, EventKind::AdaptiveFeed);
    set(&Modal::feed_hold, EventKind::FeedHold);
}

}  // namespace

void restore(Context& context, const Modal& modal) {
    State& state = context.state;
    const Modal before = state.modal;
    state.modal = modal;
    state.modal.motion = before.motion;
    state.modal.side = before.side;
    state.modal.tool_radius = before.tool_radius;
    if (context.is_compensated()) {
        state.modal.plane = before.plane;
        state.modal.system = before.system;
    }
    if (state.modal.system != before.system) { begin_system(state, modal.system); }
    restore_spindle(context, before);
    restore_coolant(context, before);
    restore_switches(context, before);
    if (modal.path_mode != before.path_mode || modal.path_tolerance != before.path_tolerance) {
        context.event(EventKind::PathMode, modal.path_mode, modal.path_tolerance);
    }
}

Result keep_state(Context& context) {
    switch (context.block.code(Group::StateKeeping)) {
        case 700:
        case 730:
            context.kept.modal = context.state.modal;
            context.kept.restores_at_return = context.block.code(Group::StateKeeping) == 730;
            break;
        case 710: context.kept = {}; break;
        case 720:
            if (!context.kept.modal) {
                return context.refuse(Group::StateKeeping, " has no saved state to restore; write M70 before it");
            }
            restore(context, *context.kept.modal);
            break;
        default: break;
    }
    return {};
}

}  // namespace lockstep::gcode
