// Adds planned faults to a machine's schedule as soon as their edge is reached.
#pragma once

#include <deque>
#include <map>
#include <vector>

#include "services/virtual/virtual_machine.hpp"
#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

class FaultPlacer : public VirtualObserver {
public:
    explicit FaultPlacer(VirtualMachine& vm) : vm_(vm), at_rest_(motor_count(vm.machine()), true) {}

    /// The faults of the next job, in this order. Faults of the previous job that have not been placed are dropped.
    void plan(const std::vector<PlannedFault>& faults) {
        planned_.assign(faults.begin(), faults.end());
        epochs_ = 0;
    }

    void on_axis(MotorIndex axis, Tick now, const AxisOutputs& out, AxisNode& node) override;
    void on_coordinator(std::size_t process, Tick now, const CoordinatorOutputs& out) override;

private:
    void take_job_event(const JobEvent& job, Tick now);
    void reach(PlannedFault::Edge edge, Tick now);
    void place(Tick from);
    double frame_slots(const PlannedFault& planned) const;
    std::size_t victim_of(const PlannedFault& planned) const;
    Ticks slots(double n) const;

    VirtualMachine& vm_;
    std::deque<PlannedFault> planned_;
    std::vector<bool> at_rest_;  // by axis, as last reported
    std::map<std::size_t, Tick> crashed_until_;
    Tick last_;                 // the begin of the last placed fault
    std::size_t followed_ = 0;  // the axes that have followed another owner since then
    int epochs_ = 0;
};

}  // namespace lockstep::simtest
