// One run from one seed: drawn, played, judged.
#pragma once

#include <optional>

#include "tests/simulation/simtest/scenario.hpp"
#include "tests/simulation/simtest/violation.hpp"

namespace lockstep::simtest {

struct Verdict {
    Violations violations;
    std::uint64_t steps = 0;
    std::uint64_t hash = 0;  // of all steps
    double simulated_s = 0;
    FaultCode fault = FaultCode::None;  // a lossy network led to it
};

/// twice: plays it a second time, to see that it comes out the same.
Verdict run_seed(std::uint64_t seed, const NetworkFaults& faults, std::optional<std::size_t> axes, bool twice);

}  // namespace lockstep::simtest
