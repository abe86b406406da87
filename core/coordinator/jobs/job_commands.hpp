// Commands of clients to the job: carried out, or refused with the reason and the remedy.
#pragma once

#include <expected>
#include <memory>

#include "core/coordinator/jobs/job_lifecycle.hpp"
#include "core/coordinator/state/refusal.hpp"

namespace lockstep::commands {

/// A program of the coordinator itself.
std::expected<std::shared_ptr<const KnownProgram>, Refusal> known_program(const Program& own,
                                                                          const MachineConfig& machine);

CommandResult home(const Command& command, JobLifecycle& jobs, CoordinatorLoop& loop);
CommandResult run(const Command& command, JobLifecycle& jobs, CoordinatorLoop& loop);
CommandResult move_own(const Command& command, BeginSteps begin_steps, JobLifecycle& jobs, CoordinatorLoop& loop);
/// Several clients may jog different axes in one job. A release is accepted in any state of the machine.
CommandResult jog(const Command& command, JobLifecycle& jobs, CoordinatorLoop& loop);
/// Begins a jog of axes whose motors must move together, where the machine rests.
CommandResult begin_path_jog(const Command& command, Tick renewed, JobLifecycle& jobs, CoordinatorLoop& loop);
/// Takes a repeated command. Returns false if its jog is over.
bool renew_jog(const Command& command, JobLifecycle& jobs, const LoopView& loop);
/// `intent`: Hold or Stop.
CommandResult interrupt(Intent intent, JobLifecycle& jobs, CoordinatorLoop& loop);
/// Axes that were jogged in the pause first return to its place, if the command says so.
CommandResult resume(const Command& command, JobLifecycle& jobs, CoordinatorLoop& loop);
/// May be called at any time. Overrides hold until they are changed again.
CommandResult set_overrides(const Command& command, JobLifecycle& jobs, const LoopView& loop);
/// A person gives up the job, held or inherited, and the fault.
CommandResult reset(JobLifecycle& jobs, CoordinatorLoop& loop);
/// Carries out any command, except those about the lease.
CommandResult carry_out(const Command& command, BeginSteps begin_steps, JobLifecycle& jobs, CoordinatorLoop& loop);

/// Call it once a slot. A job that waits for an input goes on when the input is as wanted, and waits for a person after
/// the time limit.
void go_on_at_input(JobLifecycle& jobs, CoordinatorLoop& loop);
/// While an input holds the machine, such as an open door, what moves comes to rest: held as by a client, or stopped if
/// it cannot be held. A job that waits for an input is held.
void hold_for_inputs(JobLifecycle& jobs, CoordinatorLoop& loop);

/// A probe touched something in a motion that is no probing move of it. The motion ends as at_touch_in_motion of its
/// input says.
void rest_at_touch(std::size_t input, JobLifecycle& jobs, CoordinatorLoop& loop);

/// The client with the lease fell silent. Its job on a path runs on or is held, as configured.
void lose_client(Identity client, JobLifecycle& jobs, CoordinatorLoop& loop);
/// The client has given the lease back: its job runs on without it.
void leave_to_itself(Identity client, JobLifecycle& jobs);

}  // namespace lockstep::commands
