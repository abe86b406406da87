// What the result of a probing move is compared with.
#pragma once

#include "tests/simulation/simtest/run/bench.hpp"

namespace lockstep::simtest {

/// The program ends with a probing move (draw_probes.hpp).
bool is_probing(const Program& program);

/// The places of the probe's inputs among those of the machine.
std::vector<std::size_t> probe_inputs(const MachineConfig& machine);
/// The touch of an input of the machine at `pressed`.
TouchRecord touch_record(const MachineConfig& machine, std::size_t input, Tick pressed);

/// The newest result, of a job whose steps are all recorded. `at`: the motors, at rest behind it.
ProbeRecord probe_record(Bench& bench, const Program& program, const JobRecord& job, const Counts& at);

}  // namespace lockstep::simtest
