#include "core/gcode/run/compensation.hpp"

namespace lockstep::gcode {

Result compensation(Context& context) {
    const int code = context.block.code(Group::Compensation);
    if (code == Block::kNoCode || code == 400) { return {}; }
    return context.refuse(Group::Compensation, " (cutter compensation) is not taken; let the CAM program compensate");
}

Result compensated_straight(Context& context, const Point& target, bool rapid) {
    move(context, target, rapid ? 0 : feed_of(context, context.state.program, target));
    return {};
}

Result compensated_arc(Context& context, const ArcMove& arc) {
    move_arc(context, arc);
    return {};
}

}  // namespace lockstep::gcode
