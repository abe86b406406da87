// The actions and reports of the coordinators and the axes, as seen by an observer.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "services/virtual/virtual_machine.hpp"

namespace lockstep::simtest {

class Watch : public VirtualObserver {
public:
    Watch(const VirtualMachine& vm, OnTakeover on_takeover)
        : vm_(vm), on_takeover_(on_takeover), motors_(motor_count(vm.machine())) {}

    void on_coordinator(std::size_t process, Tick now, const CoordinatorOutputs& out) override;
    /// A coordinator that ends loses its phase.
    void on_fault(Tick now, const VirtualFault& fault, bool begins) override;
    void on_axis(MotorIndex axis, Tick now, const AxisOutputs& out, AxisNode& node) override;

    /// The begin of the last fault.
    std::optional<Tick> disturbed() const { return disturbed_; }
    /// The last time at which an axis was in motion at its own device, or a fault began or ended.
    Tick moved() const { return moved_; }
    /// The last state of each motor, even if it was not delivered.
    const std::vector<AxisState>& motors() const { return motors_; }
    /// The phase of the machine is that of its owner; Waiting if it has no owner.
    MachinePhase phase() const;
    FaultCode fault() const { return fault_; }
    /// A coordinator has taken over and does not own all axes yet. It has not yet decided whether it continues the
    /// other coordinator's job.
    bool is_taking_over() const {
        const auto owner = vm_.owner();
        return on_takeover_ == OnTakeover::Continue && owner && *owner != job_of_ && phase() == MachinePhase::Waiting;
    }
    /// The outcome of the last job; none while it is in progress. A job ends with its coordinator, or after a takeover.
    std::optional<JobOutcome> outcome() const { return outcome_; }
    bool was_moving_at(std::uint64_t command) const {
        const MachinePhase phase = phase_at_command_.at(command);
        return phase == MachinePhase::Running || phase == MachinePhase::Stopping;
    }

private:
    void take_notice(std::size_t process, const CoordinatorNotice& notice);
    void take_job(std::size_t process, const JobEvent& job);
    void go_on(std::size_t process);
    void look_at_owner();
    void orphan(JobOutcome outcome);
    void cut_short(JobOutcome outcome) {
        if (!outcome_) { outcome_ = outcome; }
    }

    const VirtualMachine& vm_;
    OnTakeover on_takeover_;
    std::vector<AxisState> motors_;
    std::optional<Tick> disturbed_;
    Tick moved_;
    std::map<std::size_t, MachinePhase> phases_;  // by coordinator
    FaultCode fault_ = FaultCode::None;
    std::size_t job_of_ = 0;  // the coordinator that began or continued the last job
    bool orphaned_ = false;   // this coordinator has ended since, or gave up the machine
    std::optional<JobOutcome> outcome_;
    std::optional<std::pair<std::size_t, std::uint64_t>> homing_move_;  // process and number of the job
    std::map<std::uint64_t, MachinePhase> phase_at_command_;
};

}  // namespace lockstep::simtest
