// Limit switches that are wired to other devices than those of the motors that they concern. No device stops these
// motors by itself, so the coordinator brings the machine to rest on its path.
#pragma once

#include <vector>

#include "core/coordinator/jobs/job_lifecycle.hpp"

namespace lockstep {

class SwitchWatch {
public:
    /// Call it in each loop.
    void look(JobLifecycle& jobs, CoordinatorLoop& loop);

private:
    std::vector<bool> were_closed_;  // the machine's inputs, at the last look
};

}  // namespace lockstep
