// A whole machine in one process in virtual time: the same coordinator, axis controllers, drivers and devices as live,
// connected by a simulated network. The same options and faults give the same run, bit for bit.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "services/axis/axis_node.hpp"
#include "services/virtual/clock_mail.hpp"
#include "services/virtual/fault_schedule.hpp"
#include "services/virtual/machine_clocks.hpp"
#include "services/virtual/process_schedule.hpp"
#include "services/virtual/virtual_client.hpp"
#include "services/virtual/virtual_coordinators.hpp"
#include "services/virtual/virtual_devices.hpp"
#include "services/virtual/virtual_post.hpp"

namespace lockstep {

/// Receives all events in order of time. Records and checkers derive from it.
class VirtualObserver {
public:
    virtual ~VirtualObserver() = default;
    virtual void on_step(std::size_t /*axis*/, StepEdge /*step*/) {}
    /// Called for each change of an input or output of an axis's device, when the axis's process reads it.
    virtual void on_channel(std::size_t /*axis*/, const ChannelEvent& /*event*/) {}
    /// Called after the decisions of an axis's loop, with the node in its new state.
    virtual void on_axis(std::size_t /*axis*/, Tick /*now*/, const AxisOutputs& /*out*/, AxisNode& /*node*/) {}
    /// Called when a coordinator has taken a part of a program.
    virtual void on_part(std::size_t /*process*/, Tick /*now*/, const ProgramPart& /*part*/) {}
    /// Called after the decisions of a coordinator's loop.
    virtual void on_coordinator(std::size_t /*process*/, Tick /*now*/, const CoordinatorOutputs& /*out*/) {}
    /// Called when a fault begins and when it has ended.
    virtual void on_fault(Tick /*now*/, const VirtualFault& /*fault*/, bool /*begins*/) {}
};

struct VirtualOptions {
    MachineConfig machine;
    std::uint64_t config_hash = 1;
    std::uint64_t seed = 1;
    NetworkBehaviour network;
    Tick start{1'000'000};
    int loops_per_slot = 2;        // each process runs its loop at a random phase
    bool keeps_positions = false;  // an axis's position outlives its process
    OnTakeover on_takeover = OnTakeover::Stop;
    std::size_t coordinators = 1;  // the first to claim the machine owns it, the others stand by
    /// The clocks of each axis. Axes without an entry read the true time, like the coordinator. Clocks that differ need
    /// a machine with time_source Network.
    std::vector<AxisClocks> clocks;
    /// How late the device of each axis answers. Axes without an entry use its registers. A device that answers late
    /// has its own clock, so its axis must estimate one (estimates_clock).
    std::vector<LinkDelay> links;
    /// Returns the flight log of a process; called at each of its starts. Empty: no process has one.
    std::function<FlightLog&(std::size_t process)> flight;
    /// Makes the stores in which coordinators keep programs.
    MakeRows make_rows = memory_rows;
};

class VirtualMachine {
public:
    explicit VirtualMachine(const VirtualOptions& options);
    VirtualMachine(const VirtualMachine&) = delete;
    VirtualMachine& operator=(const VirtualMachine&) = delete;

    void observe(VirtualObserver& observer) { observers_.push_back(&observer); }

    /// Adds a fault. One with a beginning in the past begins at once. Crashes of one process must not overlap.
    void schedule(const VirtualFault& fault) { faults_.add(fault, now_); }
    /// Removes the faults that have not begun.
    void withdraw_faults() { faults_.withdraw(now_); }
    /// Whether a fault has yet to begin or end.
    bool faults_pending() const { return !faults_.empty(); }

    /// Advances to the next clock message, loop of a process, or beginning or end of a fault.
    void advance();
    /// Advances until done() returns true or `limit` has passed. Returns whether done() returned true.
    bool advance_until(const std::function<bool()>& done, Ticks limit);

    /// Sends a command over the network as a client. Returns its sequence number.
    std::uint64_t command(CommandKind kind, AxisSet axes = 0, std::uint64_t program = 0,
                          std::optional<Ticks> ticks = {});
    std::uint64_t set_overrides(const Overrides& overrides);
    /// Sends the command unchanged, such as one of another client or a renewed one.
    void send(const Command& command) { post_.multicast(now_, post_.client(), command); }
    /// Sends the last command again with the same sequence number, like a client that receives no reply.
    void repeat_command();
    /// Sends a part of a program over the network. Returns its sequence number.
    std::uint64_t send(ProgramPart part);
    /// Gives every running coordinator a complete program, without the network.
    void give_program(std::uint64_t id, const Program& program) { coordinators_.give_program(id, program); }
    const std::vector<Reply>& replies() const { return client_.replies(); }
    /// The reply to a command; null if none has come yet.
    const Reply* reply_to(std::uint64_t sequence) const { return client_.reply_to(sequence); }
    /// Removes a reply, so that replies() does not grow without bound.
    void forget_reply(std::uint64_t sequence) { client_.forget_reply(sequence); }

    /// The process number of the coordinator that owns the machine. If several claim it, the one with the highest term.
    std::optional<std::size_t> owner() const;

    Tick now() const { return now_; }
    const MachineConfig& machine() const { return options_.machine; }
    /// The newest state that the client has received.
    const std::optional<MachineState>& state() const { return client_.state(); }
    const std::vector<std::optional<AxisState>>& axis_states() const { return client_.axis_states(); }
    /// The present reading of the clock of an axis's device.
    Tick device_time(std::size_t i) const { return clocks_.device(i, now_); }
    /// An axis's device, which outlives its processes.
    SimulatedDevice& device(std::size_t i) { return devices_[i]; }
    /// A person closes or opens an input of the machine, by its number in the machine's file.
    void set_input(std::size_t input, bool closed) { devices_.set_input(input, closed, now_); }
    const SimulatedDevice& device(std::size_t i) const { return devices_[i]; }
    const RegisterWindow& registers(std::size_t i) const { return devices_.registers(i); }
    const AlterationCounts& alterations() const { return post_.alterations(); }

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

    // Start and end of processes.
    void start(std::size_t process, bool other_config = false);
    void start_axis(std::size_t axis, std::uint64_t config_hash);
    void crash(std::size_t process);
    void restart(const VirtualFault& crash);
    void start_again(std::size_t axis);

    // Faults.
    void take_edge(const FaultSchedule::Edge& edge);
    void begin(const VirtualFault& fault);
    void end(const VirtualFault& fault);

    // Loops.
    void run_loop(std::size_t process);
    template <typename Outputs>
    void act(std::size_t process, const Outputs& out);
    const AxisOutputs& decide_axis(std::size_t axis);
    CoordinatorOutputs decide_coordinator(std::size_t process);
    void carry_out(std::size_t axis, const AxisOutputs& out);
    void carry_out(std::size_t process, const CoordinatorOutputs& out);
    void note_part(std::size_t process, const TakenPart& taken, const std::vector<ProgramPart>& parts);
    void carry_out(std::size_t /*process*/, std::monostate /*nothing*/) {}
    std::uint64_t ask(const Command& command);

    /// The number of a coordinator by that of its process.
    std::size_t number_of(std::size_t process) const { return process - axes_.size(); }

    VirtualOptions options_;
    Tick now_;
    MachineClocks clocks_;
    VirtualDevices devices_;
    VirtualPost post_;
    VirtualClient client_;
    ClockMail clock_mail_;
    FaultSchedule faults_;
    ProcessSchedule schedule_;
    std::vector<Axis> axes_;
    VirtualCoordinators coordinators_;
    std::vector<Stall> stalls_;       // the axes, then the coordinators
    Identity axis_identities_ = 100;  // the next one
    std::vector<VirtualObserver*> observers_;
};

}  // namespace lockstep
