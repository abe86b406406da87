// A whole machine in one process in virtual time: the same coordinator, axis controllers, drivers and devices as live,
// joined by a simulated network. Everything follows from the options and the faults: the same give the same run, bit
// for bit.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "core/clock/clock_asker.hpp"
#include "core/coordinator/coordinator.hpp"
#include "core/flight/coordinator_flight.hpp"
#include "services/axis/axis_node.hpp"
#include "services/virtual/mail.hpp"
#include "services/virtual/virtual_clock.hpp"
#include "services/virtual/virtual_fault.hpp"
#include "services/virtual/virtual_network.hpp"

namespace lockstep {

/// Sees everything that happens, in order of time: records and checkers hang on here.
class VirtualObserver {
public:
    virtual ~VirtualObserver() = default;
    virtual void on_step(std::size_t /*axis*/, StepEdge /*step*/) {}
    /// After an axis's loop; `node` is as it is then.
    virtual void on_axis(std::size_t /*axis*/, Tick /*now*/, const AxisOutputs& /*out*/, AxisNode& /*node*/) {}
    /// After a coordinator's loop.
    virtual void on_coordinator(std::size_t /*process*/, Tick /*now*/, const CoordinatorOutputs& /*out*/) {}
    /// When a fault begins, and when it has ended.
    virtual void on_fault(Tick /*now*/, const VirtualFault& /*fault*/, bool /*begins*/) {}
};

struct VirtualOptions {
    MachineConfig machine;
    std::uint64_t config_hash = 1;
    std::uint64_t seed = 1;
    NetworkBehaviour network;
    Tick start{1'000'000};
    int loops_per_slot = 2;        // each process's loop, at a phase of its own
    bool keeps_positions = false;  // axes' positions outlive their processes
    OnTakeover on_takeover = OnTakeover::Stop;
    std::size_t coordinators = 1;  // the first to claim owns the machine, the others stand by
    /// By axis; those not here read the machine's time. The coordinator's is the machine's, and the true one. More than
    /// one time asks for a machine whose time_source is Network.
    std::vector<AxisClocks> clocks;
    /// Where each process notes its flight; asked for at each of its starts. Empty: nowhere.
    std::function<FlightLog&(std::size_t process)> flight = {};
};

class VirtualMachine {
public:
    explicit VirtualMachine(const VirtualOptions& options);

    void observe(VirtualObserver& observer) { observers_.push_back(&observer); }

    /// A fault to come; what should have begun already begins at once. Crashes of one process do not overlap.
    void schedule(const VirtualFault& fault);
    /// Faults that have not begun do not come after all.
    void withdraw_faults() {
        std::erase_if(turns_, [this](const auto& turn) { return turn.second.fault.at > now_; });
    }
    /// Whether a fault is still to come or to end.
    bool faults_pending() const { return !turns_.empty(); }

    /// Goes on to the next loop of any process, or the next turn of a fault.
    void advance();
    /// Goes on until `done` holds or `limit` has passed. True: it holds.
    bool advance_until(const std::function<bool()>& done, Ticks limit);

    /// As a client would: over the network. Returns its sequence number.
    std::uint64_t command(CommandKind kind, AxisSet axes = 0, std::uint64_t program = 0, Ticks ticks = {});
    std::uint64_t turn(const Overrides& overrides);
    /// The last command once more, with its sequence number: for a client whose reply does not come.
    void repeat_command();
    /// A program that has arrived whole at every coordinator.
    void give_program(std::uint64_t id, const Program& program);
    const std::vector<Reply>& replies() const { return replies_; }
    /// The reply to a command, once it has come.
    const Reply* reply_to(std::uint64_t sequence) const;

    /// The coordinator that owns the machine, as a process; of several that think so the one of the highest term.
    std::optional<std::size_t> owner() const;

    Tick now() const { return now_; }
    const MachineConfig& machine() const { return options_.machine; }
    /// The newest the client has heard.
    const std::optional<MachineState>& state() const { return machine_state_; }
    const std::vector<std::optional<AxisState>>& axis_states() const { return axis_states_; }
    /// What an axis's device's clock reads now.
    Tick device_time(std::size_t i) const { return clocks_of(i).device.at(now_, options_.start); }
    /// An axis's device, which outlives its processes.
    SimulatedDevice& device(std::size_t i) { return *axes_[i].device.simulated; }
    const SimulatedDevice& device(std::size_t i) const { return *axes_[i].device.simulated; }
    const AlterationCounts& alterations() const { return network_.alterations(); }

private:
    /// An axis: its device, and the process that runs it, while there is one.
    struct Axis {
        AxisDevice device;
        bool stopped = false;    // the device
        bool no_device = false;  // that could be opened
        std::optional<AxisNode> node;
        std::optional<AxisFlight> flight;
        std::optional<ClockAsker> asker;
        std::vector<ClockExchange> exchanges;  // not used yet
        KeptOrNot kept = std::unexpected(FaultCode::PositionNotKept);
    };
    /// When a process's loop runs next; that of a dead one does not.
    struct Process {
        bool alive = false;
        Tick next;
        Tick stalls_until{};  // in its next loop, if that is to come
        std::variant<std::monostate, AxisOutputs, CoordinatorOutputs> decided{};  // and not done: it stalls in a loop
    };
    /// A fault begins or ends.
    struct Turn {
        VirtualFault fault;
        bool begins = true;
    };

    void power_up();
    std::optional<std::size_t> next_process() const;
    void take_turn(const Turn& turn);
    void start(std::size_t process, bool other_config = false);
    std::expected<AxisDevice, std::string> open_device(std::size_t axis) const;
    void advance_device(std::size_t axis);
    void power_up_anew(std::size_t axis, RegisterWindow window);
    void overwrite(std::size_t axis, bool garbage);
    void strike(const VirtualFault& fault, bool begins);
    void note_flight(std::size_t process);
    void crash(std::size_t process);
    void restart(const VirtualFault& crash);
    void start_again(std::size_t axis);
    void cut(const VirtualFault& fault, bool begins);
    void disturb(const VirtualFault& fault, bool begins);

    AxisClocks clocks_of(std::size_t i) const { return i < options_.clocks.size() ? options_.clocks[i] : AxisClocks{}; }
    /// The coordinator's clock.
    Tick machine_time() const { return now_ - booted_; }
    Tick process_time(std::size_t i) const { return clocks_of(i).process.at(now_, options_.start); }
    bool is_up(std::size_t process) const;
    std::optional<std::size_t> next_clock_mail() const;
    void take_clock_mail(std::size_t process);
    bool asks_time() const { return options_.machine.timing.time_source == TimeSource::Network; }
    void ask_time(std::size_t i);

    void run_loop(std::size_t process);
    template <typename Outputs>
    void act(std::size_t process, Outputs&& out);
    AxisOutputs decide_axis(std::size_t i);
    CoordinatorOutputs decide_coordinator(std::size_t here);
    void carry_out(std::size_t process, const AxisOutputs& out);
    void carry_out(std::size_t process, const CoordinatorOutputs& out);
    void carry_out(std::size_t /*process*/, std::monostate /*nothing*/) {}
    void listen();
    void send(std::size_t from, std::size_t to, SharedMessage message);
    void multicast(VirtualMessage message, std::size_t from);
    std::size_t coordinator_address() const { return axes_.size(); }  // the first; whom axes ask for the time
    bool is_coordinator(std::size_t process) const { return process >= axes_.size(); }
    std::optional<Coordinator>& coordinator(std::size_t process) { return coordinators_[process - axes_.size()]; }
    std::size_t client_address() const { return axes_.size() + coordinators_.size(); }
    /// Clock messages are answered when they come, not in the loop.
    std::size_t clock_address(std::size_t process) const { return client_address() + 1 + process; }

    static constexpr Identity kClient = 1;

    VirtualOptions options_;
    VirtualNetwork network_;
    Mail mail_;  // of whose turn it is
    Tick now_;
    Ticks booted_;  // by so much the coordinator's clock began later than the true one
    Ticks period_;
    std::vector<Axis> axes_;
    std::vector<std::optional<Coordinator>> coordinators_;
    std::vector<std::optional<CoordinatorFlight>> coordinator_flights_;
    std::vector<Process> processes_;  // the axes, then the coordinators
    Identity axis_identities_ = 100;  // given so far
    std::multimap<Tick, Turn> turns_;
    std::vector<VirtualObserver*> observers_;
    Command command_{.client = kClient};  // the last one given
    std::vector<Reply> replies_;
    std::optional<MachineState> machine_state_;
    Tick machine_heard_;  // the true time, then
    std::vector<std::optional<AxisState>> axis_states_;
};

}  // namespace lockstep
