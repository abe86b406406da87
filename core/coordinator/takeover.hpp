// Going on with the job of an owner that fell silent: whether its axes rest where it has said that they would, and what
// is then left of the job.
//
// The owner says in each slot, of every frame that may be the last one run, where on the program the machine then rests
// (MachineState::rests). Its axes say which frame was the last. If that was the same for all, and each stands where
// that frame's tail ends, to the last bit, the rest of the job is what a resume after a hold would run: the same path,
// every position one that the undisturbed run would have had. Whatever is missing or ambiguous ends the job instead.
#pragma once

#include <expected>
#include <span>
#include <string_view>
#include <vector>

#include "core/coordinator/axis_view.hpp"
#include "core/coordinator/program_plan.hpp"

namespace lockstep {

/// What a new owner does with the job in progress.
enum class OnTakeover : std::uint8_t { Stop, Continue };

/// Why a job is not gone on with.
enum class TakeoverDoubt : std::uint8_t {
    NotAsked,        // OnTakeover::Stop
    NotRunning,      // held, paused, being stopped, or not a program
    Interrupted,     // a hold or stop was asked for meanwhile
    UnknownProgram,  // it did not arrive here
    OtherPlan,       // what the owner said of it does not fit the program
    AxisInDoubt,     // missing, started anew, not homed or in fault
    FramesDiffer,    // the axes did not run the same frames
    UnheardFrames,   // they ran frames of which the owner's word was not heard
    Misplaced,       // one is not where its frames end
};
std::string_view text_of(TakeoverDoubt doubt);

/// What is left of a job.
struct JobRest {
    std::vector<Leg> legs;
    std::size_t leg = 0;              // the one in progress
    bool leg_done = false;            // its end was reached
    PathPlace place;                  // else: where it goes on,
    std::vector<PathMove> remaining;  // what is left of the leg,
    std::vector<Position> positions;  // and where the axes rest, exactly; empty: on whole steps, as their states say
};

/// `last`: the owner's last word. `axes`: at rest, all following the new owner.
std::expected<JobRest, TakeoverDoubt> rest_of_job(const MachineState& last, const Program& program,
                                                  const MachineConfig& machine, std::span<const AxisView> axes);

}  // namespace lockstep
