// The state that an axis is in (core/axis/state/fsm.hpp), and the fault that it reports.
#pragma once

#include "core/axis/state/fsm.hpp"
#include "core/check.hpp"
#include "core/faults.hpp"

namespace lockstep {

using TransitionCounts = std::array<std::uint64_t, kAxisTransitions.size()>;

class PhaseMachine {
public:
    AxisPhase phase() const { return phase_; }
    /// The first fault since the last reset.
    FaultCode fault() const { return fault_; }
    bool has_fault() const { return fault_ != FaultCode::None; }
    /// How often each row of kAxisTransitions has been taken.
    const TransitionCounts& transitions() const { return transitions_; }

    void happen(AxisEvent event) {
        const auto row = find_transition(phase_, event);
        if (!row) { return check(may_come(phase_, event), "an axis decides only what its state allows"); }
        ++transitions_[*row];
        phase_ = kAxisTransitions[*row].to;
    }

    /// A limit switch and an emergency stop in motion have transitions of their own. Every other fault leads to Fault.
    void fail(FaultCode fault) {
        if (!has_fault()) { fault_ = fault; }
        if (fault != FaultCode::LimitHit && !is_emergency_stop(fault)) { happen(AxisEvent::Fails); }
    }

    void clear_fault() { fault_ = FaultCode::None; }
    void reset(bool is_homed) {
        clear_fault();
        happen(is_homed ? AxisEvent::ResetHomed : AxisEvent::ResetUnhomed);
    }

private:
    AxisPhase phase_ = AxisPhase::Initialize;
    FaultCode fault_ = FaultCode::None;
    TransitionCounts transitions_{};
};

}  // namespace lockstep
