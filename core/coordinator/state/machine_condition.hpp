// The machine's phase, and the fault that it reports.
#pragma once

#include <optional>
#include <vector>

#include "core/coordinator/state/coordinator_io.hpp"
#include "core/faults.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

class MachineCondition {
public:
    MachinePhase phase() const { return phase_; }
    /// The first fault since the last reset.
    FaultCode fault() const { return fault_; }
    /// The axis of the fault, if it is of an axis.
    std::optional<std::uint32_t> fault_axis() const {
        return is_of_an_axis(fault_) ? std::optional(static_cast<std::uint32_t>(fault_axis_)) : std::nullopt;
    }
    bool is_held() const { return phase_ == MachinePhase::Holding || phase_ == MachinePhase::Paused; }

    void enter(MachinePhase phase, std::vector<CoordinatorNotice>& notices) {
        if (phase == phase_) { return; }
        phase_ = phase;
        notices.push_back({CoordinatorNotice::Kind::Phase, FaultCode::None, static_cast<std::uint64_t>(phase)});
    }
    /// Returns false and changes nothing if an earlier fault is still reported.
    bool latch(FaultCode fault, std::size_t axis, std::vector<CoordinatorNotice>& notices) {
        if (fault_ != FaultCode::None) { return false; }
        fault_ = fault;
        fault_axis_ = axis;
        notices.push_back({CoordinatorNotice::Kind::Fault, fault, axis});
        return true;
    }
    void clear_fault() { fault_ = FaultCode::None; }

private:
    MachinePhase phase_ = MachinePhase::Standby;
    FaultCode fault_ = FaultCode::None;
    std::size_t fault_axis_ = 0;
};

}  // namespace lockstep
