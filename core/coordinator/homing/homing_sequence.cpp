#include "core/coordinator/homing/homing_sequence.hpp"

namespace lockstep {

AxisSet HomingSequence::next_group(const MachineConfig& machine) {
    AxisSet group = 0;
    int lowest = sequence_;
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
        const int sequence = machine.axes[i].homing.sequence;
        if (!has_axis(axes_, i) || sequence <= sequence_ || (group != 0 && sequence > lowest)) { continue; }
        group = group != 0 && sequence == lowest ? group | axis_bit(i) : axis_bit(i);
        lowest = sequence;
    }
    sequence_ = lowest;
    return group;
}

}  // namespace lockstep
