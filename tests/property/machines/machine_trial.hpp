// Operates a machine in virtual time like a person who tries it for the first time: homes it, runs three small jobs,
// and asks verify and analyze about the record.
#pragma once

#include <cstdint>
#include <string>

#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// How much computing the trial needs. Machines that home for hours are left out.
struct TrialCost {
    double loops = 0;  // of all processes
    double steps = 0;  // of all axes
    bool is_small() const { return loops < 60'000 && steps < 300'000; }
};
TrialCost cost_of_trial(const MachineSetup& machine);

/// Returns what went wrong; empty if the machine homes, does its jobs, and both tools find no fault.
std::string trouble_of(const MachineSetup& machine, std::uint64_t seed);

}  // namespace lockstep
