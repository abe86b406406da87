// Going on with the job of an owner that fell silent: whether its axes rest where it has said that they would, and what
// is then left of the job.
//
// The owner says in each slot, of every frame that may be the last one run, where on the program the machine then rests
// (MachineState::rests). Its axes say which frame was the last. If that was the same for all, and each stands where
// that frame's tail ends, to the last bit, the rest of the job is what a resume after a hold would run: the same path,
// every position one that the undisturbed run would have had. Whatever is missing or ambiguous ends the job instead.
#pragma once

#include <expected>
#include <optional>
#include <span>

#include "core/coordinator/axes/axis_view.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/coordinator/program/known_program.hpp"
#include "core/coordinator/state/coordinator_io.hpp"

namespace lockstep {

/// What is left of a job.
struct JobRest {
    std::uint32_t first = 0;     // block of the leg in progress,
    AxisCounts from;             // and where it begins
    std::optional<LegEnd> done;  // its end was reached
    PathPlace place;             // else: where it goes on,
    AxisPositions positions;     // and where the axes rest, exactly; empty: on whole steps, as their states say
};

/// False: blocks that rest_of_job looks at are being fetched; ask again in a later loop.
bool is_at_hand(const MachineState& last, const KnownProgram& program);
/// `last`: the owner's last word. `axes`: at rest, all following the new owner.
std::expected<JobRest, TakeoverDoubt> rest_of_job(const MachineState& last, const KnownProgram& program,
                                                  const MachineConfig& machine, std::span<const AxisView> axes);

}  // namespace lockstep
