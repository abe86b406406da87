// The coordinator's phase, and what it was when a command came.
#pragma once

#include <algorithm>
#include <map>
#include <optional>

#include "services/virtual/virtual_machine.hpp"

namespace lockstep::simtest {

class Watch : public VirtualObserver {
public:
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

    MachinePhase phase() const { return phase_; }
    FaultCode fault() const { return fault_; }
    /// Of the last job; nothing while it is in progress.
    std::optional<JobOutcome> outcome() const { return outcome_; }
    bool was_moving_at(std::uint64_t command) const {
        const MachinePhase phase = phase_at_command_.at(command);
        return phase == MachinePhase::Running || phase == MachinePhase::Stopping;
    }

private:
    MachinePhase phase_ = MachinePhase::Waiting;
    FaultCode fault_ = FaultCode::None;
    std::optional<JobOutcome> outcome_;
    std::map<std::uint64_t, MachinePhase> phase_at_command_;
};

}  // namespace lockstep::simtest
