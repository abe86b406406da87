// One run from one seed: drawn, played, judged.
#pragma once

#include "tests/simulation/simtest/draw/scenario.hpp"
#include "tests/simulation/simtest/record/violation.hpp"
#include "tests/simulation/simtest/run/coverage.hpp"

namespace lockstep::simtest {

struct Verdict {
    Violations violations;
    std::uint64_t steps = 0;
    std::uint64_t hash = 0;  // of all steps
    double simulated_s = 0;
    Coverage coverage;
    std::uint64_t parted = 0;           // epochs of which not all axes ran the same frames
    FaultCode fault = FaultCode::None;  // the last that what went wrong in the run led to
};

/// How a seed is run.
struct RunOptions {
    FaultKinds faults;
    MachineKind machine;
    bool twice = false;  // plays it a second time, to see that it comes out the same
    bool trace = false;  // tells it as it happens
};

Verdict run_seed(std::uint64_t seed, const RunOptions& options);

}  // namespace lockstep::simtest
