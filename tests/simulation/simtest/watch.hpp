// What the coordinator and the axes do and say, as seen beside them.
#pragma once

#include <algorithm>
#include <map>
#include <optional>

#include "services/virtual/virtual_machine.hpp"

namespace lockstep::simtest {

class Watch : public VirtualObserver {
public:
    explicit Watch(std::size_t axes) : axes_(axes) {}

    void on_coordinator(Tick /*now*/, const CoordinatorOutputs& out) override {
        for (const Reply& reply : out.replies) { phase_at_command_.try_emplace(reply.sequence, phase_); }
        for (const CoordinatorNotice& notice : out.notices) {
            if (notice.kind == CoordinatorNotice::Kind::Phase) { phase_ = static_cast<MachinePhase>(notice.number); }
            if (notice.kind == CoordinatorNotice::Kind::Fault) { fault_ = notice.fault; }
        }
        for (const JobEvent& job : out.jobs) {
            if (job.kind == JobEvent::Kind::Begun) { outcome_.reset(); }
            if (job.kind == JobEvent::Kind::Ended) { outcome_ = job.outcome; }
        }
    }

    /// With the coordinator goes what it was doing.
    void on_fault(Tick now, const VirtualFault& fault, bool begins) override {
        if (begins) { disturbed_ = now; }
        moved_ = now;
        if (!begins || fault.kind != VirtualFault::Kind::Crash || fault.process != axes_.size()) { return; }
        phase_ = MachinePhase::Waiting;
        outcome_ = JobOutcome::Failed;
    }

    void on_axis(std::size_t axis, Tick now, const AxisOutputs& out, AxisNode& /*node*/) override {
        if (!out.state) { return; }
        axes_[axis] = *out.state;
        if (!out.state->at_rest || out.state->velocity != Velocity{}) { moved_ = now; }
    }

    /// When a fault last began.
    std::optional<Tick> disturbed() const { return disturbed_; }
    /// When an axis was last seen in motion, at its own device, or a fault began or ended.
    Tick moved() const { return moved_; }
    /// What each axis said last, wherever it went.
    const std::vector<AxisState>& axes() const { return axes_; }
    MachinePhase phase() const { return phase_; }
    FaultCode fault() const { return fault_; }
    /// Of the last job; nothing while it is in progress.
    std::optional<JobOutcome> outcome() const { return outcome_; }
    bool was_moving_at(std::uint64_t command) const {
        const MachinePhase phase = phase_at_command_.at(command);
        return phase == MachinePhase::Running || phase == MachinePhase::Stopping;
    }

private:
    std::vector<AxisState> axes_;
    std::optional<Tick> disturbed_;
    Tick moved_;
    MachinePhase phase_ = MachinePhase::Waiting;
    FaultCode fault_ = FaultCode::None;
    std::optional<JobOutcome> outcome_;
    std::map<std::uint64_t, MachinePhase> phase_at_command_;
};

}  // namespace lockstep::simtest
