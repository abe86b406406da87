#include "clients/simulation/machine_recorder.hpp"

namespace lockstep {

MachineRecorder::MachineRecorder(VirtualMachine& vm, RecordSink& sink)
    : machine_(vm.machine()), sink_(sink), axes_(machine_.axes.size()) {
    vm.observe(*this);
}

/// An axis says who it is in its first loop, before it can have been told to move.
void MachineRecorder::on_step(std::size_t axis, StepEdge step) {
    if (axes_[axis]) { axes_[axis]->step(step); }
    ++steps_;
}

void MachineRecorder::on_axis(std::size_t axis, Tick /*now*/, const AxisOutputs& out, AxisNode& node) {
    auto& recorder = axes_[axis];
    if (!recorder && out.state) {
        recorder = std::make_unique<AxisRecorder>(machine_, axis, out.state->identity, sink_);
    }
    if (recorder) { recorder->loop(out, node.controller().zero_count(), node.lost_captures()); }
}

void MachineRecorder::on_coordinator(std::size_t /*process*/, Tick now, const CoordinatorOutputs& out) {
    const bool owns = out.state && out.state->phase != MachinePhase::Standby;
    if (owns && out.state->term.coordinator != owner_) {
        owner_ = out.state->term.coordinator;
        jobs_ = std::make_unique<JobRecorder>(machine_, owner_, sink_);
    }
    for (const JobEvent& event : out.jobs) {
        if (jobs_) { jobs_->record(now, event); }
    }
}

void MachineRecorder::finish() {
    for (const auto& axis : axes_) {
        if (axis) { axis->finish(); }
    }
}

}  // namespace lockstep
