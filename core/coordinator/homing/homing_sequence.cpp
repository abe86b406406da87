#include "core/coordinator/homing/homing_sequence.hpp"

namespace lockstep {

AxisSet HomingSequence::next_group(const MachineConfig& machine) {
    AxisSet group;
    int lowest = sequence_;
    for (const AxisIndex i : axes_) {
        const int sequence = machine.axes[i].homing.sequence;
        if (sequence <= sequence_ || (!group.empty() && sequence > lowest)) { continue; }
        if (sequence < lowest) { group = {}; }
        group.insert(i);
        lowest = sequence;
    }
    sequence_ = lowest;
    return group;
}

}  // namespace lockstep
