#include "clients/simulation/machine_recorder.hpp"

#include <utility>

#include "core/kinematics/motors.hpp"
#include "services/documents/program_document.hpp"

namespace lockstep {

MachineRecorder::MachineRecorder(VirtualMachine& vm, RecordSink& sink)
    : machine_(vm.machine()),
      sink_(sink),
      axes_(motor_count(machine_)),
      found_(motor_count(machine_)),
      noted_(motor_count(machine_)) {
    vm.observe(*this);
}

/// An axis publishes its identity in its first loop. Steps that it finds in its device before are an earlier process's.
void MachineRecorder::on_step(MotorIndex motor, StepEdge step) {
    axes_[motor] ? axes_[motor]->step(step) : found_[motor].push_back(step);
    ++steps_;
}

void MachineRecorder::on_channel(MotorIndex motor, const ChannelEvent& event) {
    axes_[motor] ? axes_[motor]->channel(event) : noted_[motor].push_back(event);
}

void MachineRecorder::on_axis(MotorIndex motor, Tick /*now*/, const AxisOutputs& out, AxisNode& node) {
    auto& recorder = axes_[motor];
    if (!recorder && out.state) {
        recorder = std::make_unique<AxisRecorder>(machine_, motor, out.state->identity, sink_);
        for (const StepEdge& step : std::exchange(found_[motor], {})) { recorder->step(step); }
        for (const ChannelEvent& event : std::exchange(noted_[motor], {})) { recorder->channel(event); }
    }
    if (!recorder) { return; }
    recorder->lost_channel_events(node.device().lost_channel_events());
    recorder->loop(out, node.controller().zero_count(), node.device().lost_captures());
    if (!jobs_ || !out.state) { return; }
    jobs_->note_axis({.identity = out.state->identity,
                      .axis = static_cast<std::uint32_t>(motor),
                      .tick = out.state->tick,
                      .published = recorder->published()});
}

/// Records the part as its sender has made it, if it is for the coordinator of the recorded jobs.
void MachineRecorder::on_part(std::size_t process, Tick now, const ProgramPart& part) {
    if (!jobs_ || process != owning_) { return; }
    ProgramPartWriter writer(part.head);
    for (const Block& block : part.blocks) { writer.add(block); }
    if (!part.cut.empty()) { writer.add_cut(part.cut); }
    jobs_->record(now, ProgramChunk{.program = part.program,
                                    .index = part.index,
                                    .count = part.is_last ? std::optional(part.index + 1) : std::nullopt,
                                    .bytes = writer.take()});
}

void MachineRecorder::on_coordinator(std::size_t process, Tick now, const CoordinatorOutputs& out) {
    const bool owns = out.state && out.state->phase != MachinePhase::Standby;
    if (owns && out.state->term.coordinator != owner_) {
        owner_ = out.state->term.coordinator;
        owning_ = process;
        jobs_ = std::make_unique<JobRecorder>(machine_, owner_, sink_);
    }
    now_ = now;
    if (!jobs_) { return; }
    if (owns) { note_owner(*out.state); }
    jobs_->record(now, out);
}

void MachineRecorder::note_owner(MachineState state) {
    jobs_->note(now_);
    state.published = jobs_->published();
    for (const auto& axis : axes_) {
        if (axis) { axis->note_coordinator(state); }
    }
}

/// A process that crashes loses what it has not published.
void MachineRecorder::on_fault(Tick /*now*/, const VirtualFault& fault, bool begins) {
    const bool crashes = fault.kind == VirtualFault::Kind::Crash && begins;
    if (crashes && fault.process < axes_.size()) { axes_[fault.process].reset(); }
}

void MachineRecorder::finish() {
    for (const auto& axis : axes_) {
        if (axis) { axis->finish(); }
    }
    if (jobs_) { jobs_->finish(now_); }
}

}  // namespace lockstep
