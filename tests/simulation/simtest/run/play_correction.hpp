// The correction of lost steps before a job: which motors move, and how far, follows from how far their slides were
// pushed.
#pragma once

#include "tests/simulation/simtest/run/bench.hpp"

namespace lockstep::simtest {

/// Some motor of the machine makes up lost steps.
bool corrects(const MachineConfig& machine);

/// Call it when a job was accepted, with the steps made before. Waits until the motors that must make up steps have
/// done so, and records their steps as a job without a program. `at`: the positions of the motors, updated where a
/// motor did not reach its place because of a fault. Changes nothing if no motor has to move.
void play_correction(Bench& bench, JobRecord& job, Counts& at);

}  // namespace lockstep::simtest
