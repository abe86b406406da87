// Runs a program on a whole machine in virtual time, from power-up to the program's end.
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

#include "clients/planning/program_text.hpp"
#include "core/faults.hpp"
#include "core/program.hpp"
#include "core/protocol/messages.hpp"
#include "services/record/record_sink.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// The duration of a stage of the simulation: in the machine's time, and in this computer's.
struct SimulatedStage {
    double machine_s = 0;
    double computing_s = 0;
    double times_real_time() const { return computing_s > 0 ? machine_s / computing_s : 0; }
};

struct SimulationResult {
    std::uint64_t job = 0;  // the last one of a program that probes; 0 if homing failed and the program was not begun
    JobOutcome outcome = JobOutcome::Failed;
    FaultCode fault = FaultCode::None;
    std::optional<MotorIndex> fault_motor;
    std::string trouble;                     // as text; empty if there was none
    Ticks motion;                            // duration of the program's motion, without pauses
    std::vector<std::int64_t> final_counts;  // of the axes, steps
    std::vector<ProbeTouch> touches;         // of its probing moves, in order
    std::int64_t steps = 0;                  // of all axes, homing included
    std::uint64_t most_blocks_kept = 0;      // at once, of a program that was read while it ran
    SimulatedStage homing;
    SimulatedStage running;
};

struct SimulationHooks {
    /// Called with the program's progress, 0 ... 1, now and then. Returns false to cancel.
    std::function<bool(double)> progress;
    /// Returns seconds of this computer's time, from any origin. Used only for the figures of SimulatedStage.
    std::function<double()> stopwatch;
};

/// Powers up, homes all axes, runs the program through its pauses. Fails if the caller cancels. A program that fails is
/// a result, and is recorded.
std::expected<SimulationResult, std::string> simulate(const MachineSetup& machine, const Program& program,
                                                      RecordSink& sink, const SimulationHooks& hooks = {});

/// The same for a program of any length: the machine runs it while it is read, so that memory does not grow with its
/// length. The caller has checked the whole program before. If a line has an error nevertheless, the machine runs the
/// lines before it, and the result says so. `kept_bytes` limits the kept blocks, unless the planner must look further
/// ahead. A text with GcodeSetup::awaits_touches is run part by part, up to each probing move. Not for the LAI method,
/// which plans programs as a whole.
inline constexpr std::uint64_t kKeptBlockBytes = 8'000'000;
std::expected<SimulationResult, std::string> simulate(const MachineSetup& machine, ProgramText& program,
                                                      RecordSink& sink, const SimulationHooks& hooks = {},
                                                      std::uint64_t kept_bytes = kKeptBlockBytes);

}  // namespace lockstep
