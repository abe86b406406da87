// The processes of a virtual machine, of axes and of coordinators: when they start and end, and what each does in a
// loop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "services/axis/axis_node.hpp"
#include "services/virtual/clock_mail.hpp"
#include "services/virtual/machine_clocks.hpp"
#include "services/virtual/process_schedule.hpp"
#include "services/virtual/virtual_coordinators.hpp"
#include "services/virtual/virtual_devices.hpp"
#include "services/virtual/virtual_options.hpp"
#include "services/virtual/virtual_post.hpp"

namespace lockstep {

/// Receives all events in order of time. Records and checkers derive from it.
class VirtualObserver {
public:
    virtual ~VirtualObserver() = default;
    virtual void on_step(MotorIndex /*motor*/, StepEdge /*step*/) {}
    /// Called for each change of an input or output of an axis's device, when the axis's process reads it.
    virtual void on_channel(MotorIndex /*motor*/, const ChannelEvent& /*event*/) {}
    /// Called after the decisions of an axis's loop, with the node in its new state.
    virtual void on_axis(MotorIndex /*motor*/, Tick /*now*/, const AxisOutputs& /*out*/, AxisNode& /*node*/) {}
    /// Called when a coordinator has taken a part of a program.
    virtual void on_part(std::size_t /*process*/, Tick /*now*/, const ProgramPart& /*part*/) {}
    /// Called after the decisions of a coordinator's loop.
    virtual void on_coordinator(std::size_t /*process*/, Tick /*now*/, const CoordinatorOutputs& /*out*/) {}
    /// Called when a fault begins and when it has ended.
    virtual void on_fault(Tick /*now*/, const VirtualFault& /*fault*/, bool /*begins*/) {}
};

class VirtualProcesses {
public:
    /// All processes use these objects, which must outlive this one.
    struct Surroundings {
        const VirtualOptions& options;
        const std::vector<VirtualObserver*>& observers;
        const MachineClocks& clocks;
        VirtualDevices& devices;
        VirtualPost& post;
        ClockMail& clock_mail;
    };
    /// Starts all processes.
    VirtualProcesses(const Surroundings& around, Tick now);
    VirtualProcesses(const VirtualProcesses&) = delete;  // its nodes call this object
    VirtualProcesses& operator=(const VirtualProcesses&) = delete;

    /// Starts a new process with a new identity. An axis's process finds its device in its present state.
    void start(std::size_t process, Tick now, bool other_config = false);
    void end(std::size_t process);
    /// In its next loop the process stalls up to `until` between its decisions and its actions.
    void stall(std::size_t process, Tick until) { stalls_[process].until = until; }
    /// Runs the loop of the process. Returns true if the process must end, and its supervisor start it again.
    bool run_loop(std::size_t process, Tick now);

    ProcessSchedule& schedule() { return schedule_; }
    VirtualCoordinators& coordinators() { return coordinators_; }
    /// The process number of the coordinator that owns the machine. If several claim it, the one with the highest term.
    std::optional<std::size_t> owner() const;

private:
    /// The process of an axis. `node` is empty while no process runs.
    struct Axis {
        std::optional<AxisNode> node;
        std::optional<AxisFlight> flight;
        KeptOrNot kept = std::unexpected(FaultCode::PositionNotKept);
    };
    /// A stall of a process between the decisions and the actions of a loop.
    struct Stall {
        Tick until{};                                                           // the next loop stalls up to this time
        std::variant<std::monostate, AxisOutputs, CoordinatorOutputs> decided;  // but not carried out
    };

    void start_axis(MotorIndex motor, std::uint64_t config_hash);
    template <typename Outputs>
    bool act(std::size_t process, const Outputs& out, Tick now);
    const AxisOutputs& decide_axis(MotorIndex motor, Tick now);
    CoordinatorOutputs decide_coordinator(std::size_t process, Tick now);
    bool carry_out(std::size_t process, const AxisOutputs& out, Tick now);
    bool carry_out(std::size_t process, const CoordinatorOutputs& out, Tick now);
    bool carry_out(std::size_t /*process*/, std::monostate /*nothing*/, Tick /*now*/) { return false; }
    void note_part(std::size_t process, const TakenPart& taken, const std::vector<ProgramPart>& parts, Tick now);
    /// The number of a coordinator by that of its process.
    std::size_t number_of(std::size_t process) const { return process - axes_.size(); }

    Surroundings around_;
    ProcessSchedule schedule_;
    std::vector<Axis> axes_;
    VirtualCoordinators coordinators_;
    std::vector<Stall> stalls_;       // the axes, then the coordinators
    Identity axis_identities_ = 100;  // the next one
};

}  // namespace lockstep
