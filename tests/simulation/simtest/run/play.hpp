// Plays a scenario on a machine in virtual time, as a client and as the laboratory around it.
#pragma once

#include "tests/simulation/simtest/draw/scenario.hpp"
#include "tests/simulation/simtest/record/recording.hpp"
#include "tests/simulation/simtest/record/violation.hpp"
#include "tests/simulation/simtest/run/coverage.hpp"

namespace lockstep::simtest {

struct Played {
    Recording recording;
    Coverage coverage;
    Violations violations;  // of what was asked and answered, and of ends that did not come
};

/// also: another observer, or null.
Played play(const Scenario& scenario, VirtualObserver* also = nullptr);

}  // namespace lockstep::simtest
