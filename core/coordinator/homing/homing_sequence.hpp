// Homes axes in groups, by the sequence that the configuration gives them. The axes of a group home together.
#pragma once

#include <limits>

#include "core/indices.hpp"
#include "core/machine.hpp"

namespace lockstep {

class HomingSequence {
public:
    HomingSequence() = default;
    explicit HomingSequence(AxisSet axes) : axes_(axes) {}

    AxisSet axes() const { return axes_; }

    /// Returns the axes to home next; empty if all are homed.
    AxisSet next_group(const MachineConfig& machine);

private:
    AxisSet axes_;
    int sequence_ = std::numeric_limits<int>::min();  // of the group in progress
};

}  // namespace lockstep
