// Continuing the job of an owner that fell silent: checks that the axes rest where the owner's states say, and
// determines the rest of the job.
//
// In each slot the owner publishes, for every frame that may be the last one run, where on the program the machine then
// rests (MachineState::rests). The axes report which frame was the last. If it was the same for all, and each stands,
// bit for bit, where that frame's tail ends, the rest of the job is what a resume after a hold would run. It has the
// same path and passes only positions that the undisturbed run would have passed. If anything is missing or ambiguous,
// the job ends instead.
#pragma once

#include <expected>
#include <optional>
#include <span>

#include "core/coordinator/axes/axis_view.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/coordinator/program/known_program.hpp"
#include "core/coordinator/state/coordinator_io.hpp"

namespace lockstep {

/// The rest of a job.
struct JobRest {
    std::uint32_t first = 0;     // first block of the leg in progress
    AxisCounts from;             // where this leg begins
    std::optional<LegEnd> done;  // the leg's end, if it was reached
    PathPlace place;             // otherwise: where the job continues
    MotorPositions positions;    // where the axes rest, exactly; empty: on whole steps, as in their states
};

/// Returns false while blocks that rest_of_job needs are being fetched. Ask again in a later loop.
bool is_at_hand(const MachineState& last, const KnownProgram& program);
/// `last`: the owner's last state. `motors`: at rest, all following the new owner.
std::expected<JobRest, TakeoverDoubt> rest_of_job(const MachineState& last, const KnownProgram& program,
                                                  const MachineConfig& machine, std::span<const AxisView> motors);

}  // namespace lockstep
