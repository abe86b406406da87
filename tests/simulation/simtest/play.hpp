// Plays a scenario on a machine in virtual time, as a client and as the laboratory around it.
#pragma once

#include "tests/simulation/simtest/recording.hpp"
#include "tests/simulation/simtest/scenario.hpp"
#include "tests/simulation/simtest/violation.hpp"

namespace lockstep::simtest {

struct Played {
    Recording recording;
    Violations violations;              // of what was asked and answered, and of ends that did not come
    FaultCode fault = FaultCode::None;  // a lossy network led to Fault, which it may
};

Played play(const Scenario& scenario);

}  // namespace lockstep::simtest
