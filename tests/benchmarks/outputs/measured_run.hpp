// A program on a machine in virtual time: the CPU time of its processes, and how many bytes they publish.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/machine.hpp"
#include "core/program.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// From the command to the end of the job.
struct RunFigures {
    std::int64_t steps = 0;
    std::int64_t changes = 0;                           // of outputs, that the devices made
    std::int64_t frame_bytes = 0;                       // of all frames, as FrameBytes returns them
    std::int64_t record_bytes = 0;                      // in logs
    std::vector<std::chrono::nanoseconds> coordinator;  // CPU time of each loop
    std::vector<std::chrono::nanoseconds> motors;       // likewise, of all motors; with their simulated devices
};

/// Returns the size of a frame that the coordinator publishes.
using FrameBytes = std::function<std::size_t(const Frame&)>;

/// Homes the machine and runs the program. The same arguments give the same run, loop by loop. Throws if the job does
/// not end well.
RunFigures measured_run(const MachineConfig& machine, const Program& program, const FrameBytes& frame_bytes);

}  // namespace lockstep
