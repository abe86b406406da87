// A program run from power-up to its end by a whole machine in virtual time.
//
// The same machine and program give the same record, byte for byte: identities, the origin of time and every delay
// follow from them.
#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/coordinator/coordinator.hpp"
#include "core/faults.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"
#include "services/record/record_sink.hpp"

namespace lockstep {

/// The duration of a stage of the simulation: in the machine's time, and in this computer's.
struct SimulatedStage {
    double machine_s = 0;
    double computing_s = 0;
    double times_real_time() const { return computing_s > 0 ? machine_s / computing_s : 0; }
};

struct SimulationResult {
    std::uint64_t job = 0;  // 0: homing failed, the program was not begun
    JobOutcome outcome = JobOutcome::Failed;
    FaultCode fault = FaultCode::None;
    std::optional<std::size_t> fault_axis;
    std::string trouble;                     // as text; empty if there was none
    Ticks motion;                            // of the program's motion, pauses left out
    std::vector<std::int64_t> final_counts;  // machine coordinates, steps
    std::int64_t steps = 0;                  // of all axes, homing included
    SimulatedStage homing;
    SimulatedStage running;
};

struct SimulationHooks {
    /// 0 ... 1 of the program, now and then. False: give up.
    std::function<bool(double)> progress;
    /// Seconds of this computer's time, from any origin: only for the figures of SimulatedStage.
    std::function<double()> stopwatch;
};

/// Powers up, homes all axes, runs the program through its pauses. The error: cancelled by the caller, or the machine's
/// configuration prevents it. A program that fails is a result, and is recorded.
std::expected<SimulationResult, std::string> simulate(const MachineConfig& machine, const Program& program,
                                                      RecordSink& sink, const SimulationHooks& hooks = {});

}  // namespace lockstep
