#include "core/coordinator/switch_watch.hpp"

#include "core/kinematics/motor_inputs.hpp"

namespace lockstep {
namespace {

bool is_jogged(const MachineActivity& activity) {
    const auto* const path = activity.as<activity::OnPath>();
    return activity.is<activity::Jogging>() || (path != nullptr && path->jog);
}

}  // namespace

/// A jog may begin at a closed switch, because it leads away from there. Every other motion ends at one.
std::optional<MachineFault> SwitchWatch::look(const MachineActivity& activity, const LoopView& loop) {
    std::optional<MachineFault> fault;
    were_closed_.resize(loop.machine.inputs.size());
    for (std::size_t i = 0; i < loop.machine.inputs.size(); ++i) {
        const InputConfig& input = loop.machine.inputs[i];
        if (!input.is_limit_by_message()) { continue; }
        const bool was_closed = were_closed_[i];
        were_closed_[i] = loop.axes.is_closed(i).value_or(false);
        const bool is_away = was_closed && is_jogged(activity);
        if (fault || !were_closed_[i] || is_away || !activity.in_motion()) { continue; }
        fault = {FaultCode::LimitHit, motor_at_limit(loop.machine, input)};
    }
    return fault;
}

}  // namespace lockstep
