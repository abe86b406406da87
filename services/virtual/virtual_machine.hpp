// A whole machine in one process in virtual time: the same coordinator, axis controllers, drivers and devices as live,
// joined by a simulated network. Everything follows from the options and the faults: the same give the same run, bit
// for bit.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "core/clock/clock_asker.hpp"
#include "core/coordinator/coordinator.hpp"
#include "core/flight/coordinator_flight.hpp"
#include "services/axis/axis_node.hpp"
#include "services/virtual/fault_schedule.hpp"
#include "services/virtual/machine_clocks.hpp"
#include "services/virtual/process_schedule.hpp"
#include "services/virtual/virtual_client.hpp"
#include "services/virtual/virtual_devices.hpp"
#include "services/virtual/virtual_post.hpp"

namespace lockstep {

/// Sees everything that happens, in order of time: records and checkers hang on here.
class VirtualObserver {
public:
    virtual ~VirtualObserver() = default;
    virtual void on_step(std::size_t /*axis*/, StepEdge /*step*/) {}
    /// After an axis's loop; `node` is as it is then.
    virtual void on_axis(std::size_t /*axis*/, Tick /*now*/, const AxisOutputs& /*out*/, AxisNode& /*node*/) {}
    /// A coordinator has taken a part of a program.
    virtual void on_part(std::size_t /*process*/, Tick /*now*/, const ProgramPart& /*part*/) {}
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
    std::function<FlightLog&(std::size_t process)> flight;
    /// Where coordinators keep programs.
    MakeRows make_rows = memory_rows;
};

class VirtualMachine {
public:
    explicit VirtualMachine(const VirtualOptions& options);
    VirtualMachine(const VirtualMachine&) = delete;
    VirtualMachine& operator=(const VirtualMachine&) = delete;

    void observe(VirtualObserver& observer) { observers_.push_back(&observer); }

    /// A fault to come; what should have begun already begins at once. Crashes of one process do not overlap.
    void schedule(const VirtualFault& fault) { faults_.add(fault, now_); }
    /// Faults that have not begun do not come after all.
    void withdraw_faults() { faults_.withdraw(now_); }
    /// Whether a fault is still to come or to end.
    bool faults_pending() const { return !faults_.empty(); }

    /// Goes on to the next loop of any process, or the next turn of a fault.
    void advance();
    /// Goes on until `done` holds or `limit` has passed. True: it holds.
    bool advance_until(const std::function<bool()>& done, Ticks limit);

    /// As a client would: over the network. Returns its sequence number.
    std::uint64_t command(CommandKind kind, AxisSet axes = 0, std::uint64_t program = 0, Ticks ticks = {});
    std::uint64_t turn(const Overrides& overrides);
    /// As it is: another client's, or one that is renewed.
    void send(const Command& command) { post_.multicast(now_, post_.client(), command); }
    /// The last command once more, with its sequence number: for a client whose reply does not come.
    void repeat_command();
    /// A part of a program, over the network. Returns its sequence number.
    std::uint64_t send(ProgramPart part);
    /// A program that has arrived whole at every coordinator.
    void give_program(std::uint64_t id, const Program& program);
    const std::vector<Reply>& replies() const { return client_.replies(); }
    /// The reply to a command, once it has come.
    const Reply* reply_to(std::uint64_t sequence) const { return client_.reply_to(sequence); }
    /// So that replies() does not grow for as long as the machine runs.
    void forget_reply(std::uint64_t sequence) { client_.forget_reply(sequence); }

    /// The coordinator that owns the machine, as a process; of several that think so the one of the highest term.
    std::optional<std::size_t> owner() const;

    Tick now() const { return now_; }
    const MachineConfig& machine() const { return options_.machine; }
    /// The newest that the client has received.
    const std::optional<MachineState>& state() const { return client_.state(); }
    const std::vector<std::optional<AxisState>>& axis_states() const { return client_.axis_states(); }
    /// What an axis's device's clock reads now.
    Tick device_time(std::size_t i) const { return clocks_.device(i, now_); }
    /// An axis's device, which outlives its processes.
    SimulatedDevice& device(std::size_t i) { return devices_[i]; }
    const SimulatedDevice& device(std::size_t i) const { return devices_[i]; }
    const AlterationCounts& alterations() const { return post_.alterations(); }

private:
    /// The process of an axis, while there is one.
    struct Axis {
        std::optional<AxisNode> node;
        std::optional<AxisFlight> flight;
        std::optional<ClockAsker> asker;
        std::vector<ClockExchange> exchanges;  // not used yet
        KeptOrNot kept = std::unexpected(FaultCode::PositionNotKept);
    };
    struct CoordinatorProcess {
        std::optional<Coordinator> coordinator;
        std::optional<CoordinatorFlight> flight;
    };
    /// A stall of a process between what its loop decides and what it does about it.
    struct Stall {
        Tick until{};                                                           // in its next loop, if that is to come
        std::variant<std::monostate, AxisOutputs, CoordinatorOutputs> decided;  // and not done
    };

    // Processes begin and end.
    void start(std::size_t process, bool other_config = false);
    void start_axis(std::size_t axis, std::uint64_t config_hash);
    void start_coordinator(std::size_t process, std::uint64_t config_hash);
    void crash(std::size_t process);
    void restart(const VirtualFault& crash);
    void start_again(std::size_t axis);

    // Faults.
    void take_turn(const FaultSchedule::Turn& turn);
    void begin(const VirtualFault& fault);
    void end(const VirtualFault& fault);

    // Clock messages.
    std::optional<std::size_t> next_clock_mail() const;
    void take_clock_mail(std::size_t process);
    bool asks_time() const { return options_.machine.timing.time_source == TimeSource::Network; }
    void ask_time(std::size_t axis);

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

    CoordinatorProcess& coordinator(std::size_t process) { return coordinators_[process - axes_.size()]; }

    VirtualOptions options_;
    Tick now_;
    MachineClocks clocks_;
    VirtualDevices devices_;
    VirtualPost post_;
    VirtualClient client_;
    FaultSchedule faults_;
    ProcessSchedule schedule_;
    std::vector<Axis> axes_;
    std::vector<CoordinatorProcess> coordinators_;
    std::vector<Stall> stalls_;       // the axes, then the coordinators
    Identity axis_identities_ = 100;  // given so far
    std::vector<VirtualObserver*> observers_;
};

}  // namespace lockstep
