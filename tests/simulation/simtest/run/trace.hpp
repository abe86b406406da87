// Prints the events of a run, one line for each, for the replay of a seed.
#pragma once

#include "services/virtual/virtual_machine.hpp"

namespace lockstep::simtest {

class Trace : public VirtualObserver {
public:
    explicit Trace(const MachineConfig& machine) : machine_(machine) {}

    void on_axis(MotorIndex axis, Tick now, const AxisOutputs& out, AxisNode& node) override;
    void on_coordinator(std::size_t number, Tick now, const CoordinatorOutputs& out) override;
    void on_fault(Tick now, const VirtualFault& fault, bool begins) override;

private:
    std::string process(std::size_t number) const;
    void line(Tick now, const std::string& who, const std::string& what) const;

    const MachineConfig& machine_;
};

}  // namespace lockstep::simtest
