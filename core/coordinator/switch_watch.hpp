// Limit switches that are wired to other devices than those of the motors that they concern. No device stops these
// motors by itself, so the coordinator brings the machine to rest on its path.
#pragma once

#include <optional>
#include <vector>

#include "core/coordinator/jobs/activity.hpp"

namespace lockstep {

class SwitchWatch {
public:
    /// Call it in each loop. Returns why the motion must end, if a switch ends it.
    std::optional<MachineFault> look(const MachineActivity& activity, const LoopView& loop);

private:
    std::vector<bool> were_closed_;  // the machine's inputs, at the last look
};

}  // namespace lockstep
