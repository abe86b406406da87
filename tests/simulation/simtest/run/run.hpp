// One run from one seed: drawn, played, checked.
#pragma once

#include "tests/simulation/simtest/draw/scenario.hpp"
#include "tests/simulation/simtest/record/violation.hpp"
#include "tests/simulation/simtest/run/coverage.hpp"

namespace lockstep::simtest {

struct RunResult {
    Violations violations;
    std::uint64_t steps = 0;
    std::uint64_t hash = 0;       // over all steps
    std::uint64_t published = 0;  // PublicationHash
    double simulated_s = 0;
    Coverage coverage;
    std::uint64_t parted = 0;           // epochs in which not all axes ran the same frames
    FaultCode fault = FaultCode::None;  // the last Fault of the machine
};

/// The options of a run.
struct RunOptions {
    FaultKinds faults;
    MachineKind machine;
    bool twice = false;  // plays it a second time, to check that the steps are the same
    bool trace = false;  // prints its events
};

RunResult run_seed(std::uint64_t seed, const RunOptions& options);

}  // namespace lockstep::simtest
