// Puts planned faults into a machine's schedule as soon as what they wait for has come.
#pragma once

#include <deque>
#include <map>
#include <vector>

#include "services/virtual/virtual_machine.hpp"
#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

class FaultPlacer : public VirtualObserver {
public:
    explicit FaultPlacer(VirtualMachine& vm) : vm_(vm), at_rest_(vm.machine().axes.size(), true) {}

    /// Of the job that begins next, in this order. Those of the job before that have not been placed are dropped.
    void plan(const std::vector<PlannedFault>& faults) {
        planned_.assign(faults.begin(), faults.end());
        epochs_ = 0;
    }

    void on_axis(std::size_t axis, Tick now, const AxisOutputs& out, AxisNode& node) override;
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
    std::vector<bool> at_rest_;  // by axis, as last said
    std::map<std::size_t, Tick> crashed_until_;
    Tick last_;                 // when the fault placed last begins
    std::size_t followed_ = 0;  // axes that have followed another owner since
    int epochs_ = 0;
};

}  // namespace lockstep::simtest
