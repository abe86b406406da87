// How often the runs reached each state and event of the protocol and its state machines, and which they never reached.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "services/virtual/virtual_machine.hpp"

namespace lockstep::simtest {

/// Counts by group and name. From the start it contains everything that can be reached, with count 0.
class Coverage {
public:
    using Counts = std::map<std::string, std::uint64_t, std::less<>>;

    Coverage();
    void hit(std::string_view group, std::string_view name, std::uint64_t times = 1);
    void add(const Coverage& other);
    const std::map<std::string, Counts, std::less<>>& groups() const { return groups_; }

    /// The alterations in the network of a run.
    void take(const AlterationCounts& alterations);

private:
    std::map<std::string, Counts, std::less<>> groups_;
};

/// Collects the coverage of a machine in motion.
class CoverageWatch : public VirtualObserver {
public:
    CoverageWatch(const MachineConfig& machine, Coverage& coverage);
    /// Adds the counts of the axis processes that still run.
    ~CoverageWatch() override;
    CoverageWatch(const CoverageWatch&) = delete;
    CoverageWatch& operator=(const CoverageWatch&) = delete;

    void on_axis(MotorIndex axis, Tick now, const AxisOutputs& out, AxisNode& node) override;
    void on_coordinator(std::size_t process, Tick now, const CoordinatorOutputs& out) override;
    void on_fault(Tick now, const VirtualFault& fault, bool begins) override;

private:
    void take_transitions(std::size_t axis);
    void take_check(std::size_t axis, Slot now, FrameNumber k, bool armed);
    Slot start_slot(std::size_t axis, FrameNumber k) const;

    MachineConfig machine_;
    Coverage& coverage_;
    std::vector<TransitionCounts> transitions_;  // of each axis's process until now
    std::vector<Epoch> epoch_;                   // of each axis
    std::map<Epoch, Tick> starts_;
};

}  // namespace lockstep::simtest
