#include "tests/simulation/simtest/run/watch.hpp"

namespace lockstep::simtest {

void Watch::on_coordinator(std::size_t process, Tick /*now*/, const CoordinatorOutputs& out) {
    for (const Reply& reply : out.replies) { phase_at_command_.try_emplace(reply.sequence, phase()); }
    for (const CoordinatorNotice& notice : out.notices) { take_notice(process, notice); }
    for (const JobEvent& job : out.jobs) { take_job(process, job); }
}

/// For the test the job has ended when another coordinator has taken over and all axes follow it. If the new owner
/// continues the job, it reports that earlier.
void Watch::take_notice(std::size_t process, const CoordinatorNotice& notice) {
    using Kind = CoordinatorNotice::Kind;
    if (notice.kind == Kind::Fault) { fault_ = notice.fault; }
    if (notice.kind == Kind::StoodDown && process == job_of_) { orphan(JobOutcome::Stopped); }
    if (notice.kind == Kind::JobContinued) { go_on(process); }
    if (notice.kind == Kind::Phase) { phases_[process] = static_cast<MachinePhase>(notice.number); }
    if (notice.kind == Kind::Phase || notice.kind == Kind::StoodDown) { look_at_owner(); }
}

/// If two coordinators own the machine for a moment, the remaining one may have been idle before.
void Watch::look_at_owner() {
    const auto owner = vm_.owner();
    const bool other = owner && (*owner != job_of_ || orphaned_);
    if (other && phase() == MachinePhase::Idle) { cut_short(JobOutcome::Stopped); }
}

/// A move of axes that home by touch is a job within the homing, and a correction of lost steps one within its program.
/// A new owner may give a number again that the one before it gave while it was cut off.
void Watch::take_job(std::size_t process, const JobEvent& job) {
    const std::pair number{process, job.job};
    if (job.kind == JobEvent::Kind::Begun && homing_move_ == number) { homing_move_.reset(); }
    if (job.kind == JobEvent::Kind::Begun && job.job_kind == JobKind::Home && job.program) { homing_move_ = number; }
    if (number == homing_move_ || job.job_kind == JobKind::Return) { return; }
    if (job.kind == JobEvent::Kind::Begun) {
        job_of_ = process;
        orphaned_ = false;
        outcome_.reset();
    }
    if (job.kind == JobEvent::Kind::Ended && process == job_of_) { outcome_ = job.outcome; }
}

void Watch::on_fault(Tick now, const VirtualFault& fault, bool begins) {
    if (begins) { disturbed_ = now; }
    moved_ = now;
    if (!begins || fault.kind != VirtualFault::Kind::Crash || fault.process < motors_.size()) { return; }
    phases_.erase(fault.process);
    if (fault.process == job_of_) { orphan(JobOutcome::Failed); }
}

/// Also if the job failed: the previous coordinator was cut off and lost the axes, which now follow this one.
void Watch::go_on(std::size_t process) {
    job_of_ = process;
    orphaned_ = false;
    outcome_.reset();
}

/// The coordinator of the job has left it: the job has ended, unless another one continues it.
void Watch::orphan(JobOutcome outcome) {
    orphaned_ = true;
    if (on_takeover_ == OnTakeover::Stop) { cut_short(outcome); }
}

void Watch::on_axis(MotorIndex axis, Tick now, const AxisOutputs& out, AxisNode& /*node*/) {
    if (vm_.device(axis).in_motion()) { moved_ = now; }  // also while a restarted process sends nothing yet
    if (!out.state) { return; }
    motors_[axis] = *out.state;
    if (!out.state->at_rest || out.state->velocity != Velocity{}) { moved_ = now; }
}

MachinePhase Watch::phase() const {
    const auto owner = vm_.owner();
    const auto phase = owner ? phases_.find(*owner) : phases_.end();
    return phase == phases_.end() ? MachinePhase::Waiting : phase->second;
}

}  // namespace lockstep::simtest
