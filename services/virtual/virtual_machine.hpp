// A whole machine in one process in virtual time: the same coordinator, axis controllers, drivers and devices as live,
// joined by a simulated network. Everything follows from the options: the same options give the same run, bit for bit.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/coordinator/coordinator.hpp"
#include "services/axis/axis_node.hpp"
#include "services/virtual/virtual_network.hpp"

namespace lockstep {

/// Sees everything that happens, in order of time: records and checkers hang on here.
class VirtualObserver {
public:
    virtual ~VirtualObserver() = default;
    virtual void on_step(std::size_t /*axis*/, StepEdge /*step*/) {}
    /// After an axis's loop; `node` is as it is then.
    virtual void on_axis(std::size_t /*axis*/, Tick /*now*/, const AxisOutputs& /*out*/, AxisNode& /*node*/) {}
    virtual void on_coordinator(Tick /*now*/, const CoordinatorOutputs& /*out*/) {}
};

struct VirtualOptions {
    MachineConfig machine;
    std::uint64_t config_hash = 1;
    std::uint64_t seed = 1;
    NetworkBehaviour network;
    Tick start{1'000'000};
    int loops_per_slot = 2;  // each process's loop, at a phase of its own
};

class VirtualMachine {
public:
    explicit VirtualMachine(const VirtualOptions& options);

    void observe(VirtualObserver& observer) { observers_.push_back(&observer); }

    /// Goes on to the next loop of any process.
    void advance();
    /// Goes on until `done` holds or `limit` has passed. True: it holds.
    bool advance_until(const std::function<bool()>& done, Ticks limit);

    /// As a client would: over the network. Returns its sequence number.
    std::uint64_t command(CommandKind kind, std::uint32_t axes = 0, std::uint64_t program = 0);
    /// The last command once more, with its sequence number: for a client whose reply does not come.
    void repeat_command();
    /// A program that has arrived whole at the coordinator.
    void give_program(std::uint64_t id, Program program) { coordinator_.accept_program(id, std::move(program)); }
    const std::vector<Reply>& replies() const { return replies_; }
    /// The reply to a command, once it has come.
    const Reply* reply_to(std::uint64_t sequence) const;

    Tick now() const { return now_; }
    const MachineConfig& machine() const { return options_.machine; }
    /// The newest the client has heard.
    const std::optional<MachineState>& state() const { return machine_state_; }
    const std::vector<std::optional<AxisState>>& axis_states() const { return axis_states_; }
    AxisNode& axis(std::size_t i) { return axes_[i]; }

private:
    struct Process {
        Tick next;
        std::size_t number = 0;
    };
    void step_axis(std::size_t i);
    void step_coordinator();
    void listen();
    void send(std::size_t to, SharedMessage message);
    void multicast(VirtualMessage message, std::size_t from);
    std::size_t coordinator_address() const { return axes_.size(); }
    std::size_t client_address() const { return axes_.size() + 1; }

    static constexpr Identity kClient = 1;

    VirtualOptions options_;
    VirtualNetwork network_;
    Tick now_;
    Ticks period_;
    std::vector<AxisNode> axes_;
    Coordinator coordinator_;
    std::vector<Process> processes_;  // the axes, then the coordinator
    std::vector<VirtualObserver*> observers_;
    Command command_{.client = kClient};  // the last one given
    std::vector<Reply> replies_;
    std::optional<MachineState> machine_state_;
    std::vector<std::optional<AxisState>> axis_states_;
};

}  // namespace lockstep
