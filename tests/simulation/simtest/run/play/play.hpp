// Plays a scenario on a machine in virtual time: gives its commands and injects its faults.
#pragma once

#include <span>

#include "tests/simulation/simtest/draw/scenario.hpp"
#include "tests/simulation/simtest/record/recording.hpp"
#include "tests/simulation/simtest/record/violation.hpp"
#include "tests/simulation/simtest/run/coverage.hpp"

namespace lockstep::simtest {

struct Played {
    Recording recording;
    Coverage coverage;
    Violations violations;  // wrong answers and missed deadlines
};

/// `also`: more observers.
Played play(const Scenario& scenario, std::span<VirtualObserver* const> also = {});

}  // namespace lockstep::simtest
