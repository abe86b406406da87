// G38.2 to G38.5: straight moves that end where a probe touches.
#include "core/gcode/run/steps.hpp"

namespace lockstep::gcode {
namespace {

/// Refuses what LinuxCNC refuses, and words that act behind the motion: the program cannot go on before the touch is
/// known.
Result check_probing(const Context& context, const Point& target) {
    if (context.is_compensated()) {
        return context.refuse_motion(" is not possible while cutter compensation is on; write G40 before it");
    }
    if (context.state.modal.feed_mode == FeedMode::InverseTime) {
        return context.refuse_motion(" is not possible in inverse time (G93); write G94 and F before it");
    }
    if (context.block.has(Group::Stop)) {
        return context.refuse(Group::Stop, " is in the same block as a probing move; use two lines");
    }
    if (!context.block.has_axes()) { return context.refuse_motion(" has no axis; write where the move ends at most"); }
    if (target == context.state.program) {
        return context.refuse_motion(" goes nowhere: the axes stand at its end already; write a place further on");
    }
    return check_feed(context);
}

}  // namespace

Result probe(Context& context) {
    State& state = context.state;
    const Point target = context.target();
    if (auto checked = check_probing(context, target); !checked) { return checked; }
    const auto number = context.block.find('P');
    if (number && (!whole(*number) || *number < 0)) {
        return context.refuse('P', " is not the number of a probe; write a whole number from 0");
    }
    const Point machine = machine_target(state, target);
    const int kind = context.motion - 382;
    context.emit(Probing{.target = machine,
                         .feed = feed_of(context, state.program, target),
                         .probe = number ? whole(*number) : std::nullopt,
                         .opens = kind >= 2,
                         .must_touch = kind % 2 == 0});
    state.cutter.stands.reset();
    note_touch(state, {.touched = true, .at = machine, .rest = machine});
    state.program = target;
    context.awaits_touch = context.setup.awaits_touches;
    return {};
}

}  // namespace lockstep::gcode
