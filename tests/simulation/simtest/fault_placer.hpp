// Puts planned faults into a machine's schedule as soon as what they wait for has begun.
#pragma once

#include <cmath>
#include <optional>

#include "services/virtual/virtual_machine.hpp"
#include "tests/simulation/simtest/scenario.hpp"

namespace lockstep::simtest {

class FaultPlacer : public VirtualObserver {
public:
    explicit FaultPlacer(VirtualMachine& vm) : vm_(vm) {}

    /// Of the job that begins next. Nothing: none.
    void plan(const std::optional<PlannedFault>& fault) {
        planned_ = fault;
        epochs_ = 0;
    }

    void on_coordinator(Tick now, const CoordinatorOutputs& out) override {
        for (const JobEvent& job : out.jobs) {
            const bool homes = job.kind == JobEvent::Kind::Begun && job.job_kind == JobKind::Home;
            if (planned_ && homes) { place(now); }
            if (planned_ && job.kind == JobEvent::Kind::EpochBegun && epochs_++ == planned_->epoch) {
                place(job.start + slots(frame_slots()));
            }
        }
    }

private:
    /// Of the edge, from the start of the epoch.
    double frame_slots() const {
        const ProtocolTiming& t = vm_.machine().timing;
        const double start = static_cast<double>(planned_->frame - 1) * t.frame_slots;
        switch (planned_->edge) {
            case PlannedFault::Edge::FirstSend: return start - t.send_ahead_slots;
            case PlannedFault::Edge::Evidence: return start - t.check_slots() - 1 - t.freshness_slots;
            case PlannedFault::Edge::Check: return start - t.check_slots();
            case PlannedFault::Edge::LastCheck: return start - 4;
            case PlannedFault::Edge::Start: return start;
        }
        return start;
    }
    Ticks slots(double n) const { return {std::llround(n * static_cast<double>(vm_.machine().slot_ticks().value))}; }
    void place(Tick from) {
        VirtualFault fault = planned_->fault;
        fault.at = std::max(vm_.now() + Ticks{1}, from + slots(planned_->slots));
        planned_.reset();
        vm_.schedule(fault);
    }

    VirtualMachine& vm_;
    std::optional<PlannedFault> planned_;
    int epochs_ = 0;
};

}  // namespace lockstep::simtest
