// Touches of probes in motions that do not probe with them: a tool has met something. Then the machine comes to rest on
// its path, as the inputs ask for it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/coordinator/jobs/activity.hpp"

namespace lockstep {

class TouchWatch {
public:
    /// Call it in each loop. Returns the machine's inputs that touched. Only a change counts, so that the axes can be
    /// moved away from what they touch.
    std::vector<std::size_t> look(const MachineActivity& activity, const LoopView& loop);

private:
    bool has_just_closed(std::size_t input, const LoopView& loop);

    std::vector<std::optional<bool>> were_closed_;  // the machine's inputs, at the last look
};

}  // namespace lockstep
