// A client's connection to a machine: states received from coordinator and axes, commands sent, and the replies.
#pragma once

#include <chrono>
#include <expected>
#include <map>
#include <optional>
#include <variant>
#include <vector>

#include "clients/session/chosen_machine.hpp"
#include "clients/session/follow/command_tracker.hpp"
#include "clients/session/follow/owner_watch.hpp"
#include "clients/session/lease/lease_keeper.hpp"
#include "clients/session/received/received_axes.hpp"
#include "clients/session/received/received_values.hpp"
#include "clients/session/upload/program_upload.hpp"
#include "clients/text/failure.hpp"
#include "core/protocol/messages.hpp"
#include "services/wire/bus/bus.hpp"
#include "services/wire/dds/present_processes.hpp"

namespace lockstep {

/// With security, a Look session uses a viewer's keys, a Command session a client's.
enum class Purpose { Look, Command };

class Session {
public:
    /// Joins the machine's network; nothing is received yet. Fails if DDS cannot be opened, or security refuses the
    /// client.
    static std::expected<Session, Failure> join(const ChosenMachine& machine, Purpose purpose);
    /// join() and reach().
    static std::expected<Session, Failure> open(const ChosenMachine& machine, Purpose purpose);

    /// Waits for messages and processes them. Before that it sends what is due: the program and the lease's commands.
    void receive(std::chrono::nanoseconds at_most);
    /// Receives until done() returns true, at most for `patience` of the running time. Returns whether it did.
    template <typename Done>
    bool receive_until(std::chrono::nanoseconds patience, Done done) {
        const std::chrono::nanoseconds deadline = owner_.running_time() + patience;
        while (!done()) {
            if (owner_.running_time() >= deadline) { return false; }
            receive(std::chrono::milliseconds{20});
        }
        return true;
    }

    const ChosenMachine& machine() const { return machine_; }
    const MachineSetup& config() const { return machine_.config; }
    /// True if the coordinator runs another configuration than the client has; its positions and limits may differ.
    bool config_differs() const { return state() && state()->state.config_hash != machine_.hash; }
    /// Whether a coordinator publishes states, and a commanding client is matched with it.
    bool is_reached() const;

    OwnerWatch& owner() { return owner_; }
    const OwnerWatch& owner() const { return owner_; }
    /// The newest one received; nullopt before the first.
    const std::optional<Received<MachineState>>& state() const { return owner_.state(); }
    /// True if no state of the coordinator came for longer than any stall that the machine's timing allows, while this
    /// client looked for one.
    bool is_silent() const { return owner_.sight().is_silent; }
    /// Whether a standby coordinator is received.
    bool has_standby() const;
    const ReceivedAxes& received() const { return received_; }
    const ReceivedValues& values() const { return values_; }
    /// The machine's processes on the network, also those that publish nothing yet.
    std::vector<PresentProcess> present() const;

    /// Subscribes to events of programs. Returns whether they are received from every coordinator.
    bool follow_events();
    /// Returns the events received since the last call, oldest first. A slow reader may miss events: see
    /// PublishedEvent::sequence.
    std::vector<PublishedEvent> take_events();

    /// Sends the command when that is due, and takes its reply. Call it in each loop until the command is over.
    CommandStep follow(CommandTracker& tracker);
    /// The program to send. receive() sends what is due.
    ProgramUpload& upload() { return upload_; }
    const ProgramUpload& upload() const { return upload_; }

    // One writer at a time may move and change the machine: while a writer holds the lease, only its commands are
    // accepted. While nobody holds it, the commands of every client are accepted.
    /// receive() keeps the lease: a client that does not receive for kLeaseSilence_ms loses it.
    LeaseKeeper& lease() { return lease_; }
    const LeaseKeeper& lease() const { return lease_; }
    /// Sends what the lease needs now.
    void keep_lease();
    /// The writer that the coordinator publishes, this client's or another. Null if there is none, or nothing is
    /// received yet.
    const HeldLease* writer() const { return state() && state()->state.lease ? &*state()->state.lease : nullptr; }

private:
    using Bus = std::variant<ViewerBus, ClientBus>;
    Session(const ChosenMachine& machine, Bus bus);
    ViewerBus& viewer_bus() {
        return std::visit([](ViewerBus& bus) -> ViewerBus& { return bus; }, bus_);
    }
    /// Only for a session with Purpose::Command.
    ClientBus& client_bus() { return std::get<ClientBus>(bus_); }
    void send_program();
    void take_messages();
    void take_replies();

    ChosenMachine machine_;
    Bus bus_;
    Identity client_;
    LeaseKeeper lease_;
    ProgramUpload upload_;
    OwnerWatch owner_;
    std::optional<Received<MachineState>> standby_;
    ReceivedAxes received_;
    ReceivedValues values_;  // the owner's
    std::optional<Reader<PublishedEvent>> events_;
    std::uint64_t sequence_ = 0;              // of the last command
    std::map<std::uint64_t, Reply> replies_;  // to this client, not read yet
};

/// See ProgramUpload::is_overdue.
inline bool is_upload_overdue(Session& session) {
    return session.upload().is_overdue(session.owner().sight(), session.owner().running_time());
}

}  // namespace lockstep
