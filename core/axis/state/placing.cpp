#include "core/axis/state/placing.hpp"

namespace lockstep {
namespace {

FaultCode refusal(bool rests, const AxisLoop& loop) {
    if (!rests || loop.device.status().moving) { return FaultCode::Busy; }
    if (loop.condition.phases.phase() == AxisPhase::Fault) { return FaultCode::InFault; }
    return loop.device.is_present() ? FaultCode::None : FaultCode::DeviceMissing;
}

/// The device's count at the axis's zero.
std::int64_t zero_of(const AxisCommand& order, const AxisLoop& loop) {
    return loop.device.status().position.count() - order.target_steps;
}

}  // namespace

void assume_place(const AxisCommand& order, bool rests, AxisLoop& loop) {
    if (const FaultCode why = refusal(rests, loop); why != FaultCode::None) { return loop.refuse(order, why); }
    AxisCondition& condition = loop.condition;
    condition.phases.clear_fault();
    condition.position.begin_homing();
    condition.phases.happen(AxisEvent::HomingBegins);
    condition.position.assume_zero(zero_of(order, loop), loop.device.status());
    condition.orders.end(FaultCode::None);
}

void take_place(const AxisCommand& order, bool rests, AxisLoop& loop) {
    if (const FaultCode why = refusal(rests, loop); why != FaultCode::None) { return loop.refuse(order, why); }
    AxisCondition& condition = loop.condition;
    if (!condition.position.is_assumed()) { return loop.refuse(order, FaultCode::NotHomed); }
    condition.position.set_zero(zero_of(order, loop), loop.device.status());
    condition.phases.happen(AxisEvent::Zeroed);
    loop.notice({AxisNotice::Kind::Homed, FaultCode::None, 0});
    condition.orders.end(FaultCode::None);
}

}  // namespace lockstep
