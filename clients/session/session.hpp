// A client's connection to a machine: states received from coordinator and axes, commands sent, and the replies.
#pragma once

#include <chrono>
#include <expected>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "clients/session/chosen_machine.hpp"
#include "clients/session/lease/lease_keeper.hpp"
#include "clients/session/program_sender.hpp"
#include "clients/text/failure.hpp"
#include "core/gcode/kept_values.hpp"
#include "core/program.hpp"
#include "core/protocol/axis_health.hpp"
#include "core/protocol/messages.hpp"
#include "services/documents/values/values_document.hpp"
#include "services/runtime/stop_signal.hpp"
#include "services/wire/bus/bus.hpp"
#include "services/wire/dds/present_processes.hpp"

namespace lockstep {

inline constexpr std::chrono::seconds kReachPatience{3};

template <typename State>
struct Received {
    State state;
    std::chrono::nanoseconds time;  // CLOCK_MONOTONIC of this host
};

/// With security, a session that looks uses the keys of a viewer, one that commands those of a client.
enum class Purpose { Look, Command };

class Session {
public:
    /// On the machine's network; nothing is received yet. Error: DDS cannot be opened, or security refuses the client.
    static std::expected<Session, Failure> join(const ChosenMachine& machine, Purpose purpose);
    /// join() and reach().
    static std::expected<Session, Failure> open(const ChosenMachine& machine, Purpose purpose);

    /// Waits until a coordinator publishes states and is matched with this client. Error: none is; which axes are
    /// received, and the remedy.
    std::expected<void, Failure> reach(std::chrono::nanoseconds patience = kReachPatience);
    /// Waits until every axis is received. Error: an axis that is not.
    std::expected<void, Failure> reach_axes();
    /// Waits for the axes that the coordinator receives, and shortly for the others: those still missing count as
    /// absent.
    void await_axes();
    /// Waits for the live figures of every axis that is received: they are published ten times a second.
    void await_healths(std::chrono::nanoseconds patience);

    /// Receives events of programs from now on; waits until every coordinator's are received. Error: they are not.
    std::expected<void, Failure> follow_events(std::chrono::nanoseconds patience);
    /// Those received since the last call, oldest first. Those of a reader that is slow may be missing: see
    /// PublishedEvent::sequence.
    std::vector<PublishedEvent> take_events();
    /// Waits for messages and takes them.
    void receive(std::chrono::nanoseconds at_most);

    const MachineConfig& config() const { return machine_.config; }
    /// The coordinator runs another configuration than the client has: its positions and limits may differ.
    bool config_differs() const { return state_ && state_->state.config_hash != machine_.hash; }

    /// The newest received; nothing before the first.
    const std::optional<Received<MachineState>>& state() const { return state_; }
    const std::optional<Received<AxisState>>& axis(std::size_t i) const { return axes_[i]; }
    const std::optional<AxisHealth>& health(std::size_t i) const { return healths_[i]; }
    /// Whether a state came within the time after which the machine counts an axis as absent.
    bool axis_present(std::size_t i) const;
    /// Whether a standby coordinator is received.
    bool has_standby() const;
    /// No state of the coordinator for longer than any stall that the machine's timing allows.
    bool is_silent() const;
    Failure silent() const;
    /// The machine's processes on the network, also those that publish nothing yet.
    std::vector<PresentProcess> present() const;

    /// Repeats the command until the reply comes; fills in client and sequence. Error: no reply, or none soon after a
    /// signal to `stop`.
    std::expected<Reply, Failure> command(Command command, const StopSignal* stop = nullptr);
    /// Gives the command this client's next number and sends it, for a command that is repeated while it holds.
    void begin(Command& command);
    void repeat(const Command& command) { (void)client_bus().commands.write(command); }
    // One writer at a time moves and changes the machine: its commands are accepted while it holds the lease. While
    // nobody does, those of every client are.
    /// Names this client as the writer, from now on. Give the lease back first. With an identity of 0 nobody shares it.
    void write_as(LeaseHolder writer) { lease_.write_as(std::move(writer)); }
    /// Waits for the lease; the reply refuses it where another writer has it. receive() keeps it until give_lease(),
    /// or until another takes it over. `takes_over`: from another writer, too. Error: as command().
    std::expected<Reply, Failure> take_lease(bool takes_over = false, const StopSignal* stop = nullptr);
    /// The same without waiting; lease_reply() has the answer once it has come.
    void ask_for_lease(bool takes_over = false);
    const std::optional<Reply>& lease_reply() const { return lease_.answer(); }
    /// Repeats what is due. receive() calls it: a client that does not receive for kLeaseSilence_ms loses the lease.
    void keep_lease();
    /// Waits at most so long until the coordinator has answered. Without the lease nothing is sent.
    void give_lease(std::chrono::nanoseconds patience = {});
    bool holds_lease() const { return lease_.is_held(); }
    /// LeaseHolder::id of this client's writer.
    std::uint64_t writer_id() const { return lease_.writer().id; }
    /// The writer that the coordinator publishes, this one or another. Null: nobody, or nothing is received yet.
    const HeldLease* writer() const { return state_ && state_->state.lease ? &*state_->state.lease : nullptr; }

    /// The newest reply to it. Null: none has come yet.
    const Reply* reply_to(const Command& command) const;
    /// Sends an emergency stop to coordinator and axes: axes stop by themselves. Nothing: no coordinator replied in
    /// time.
    std::optional<Reply> stop_at_once(std::chrono::nanoseconds patience);
    /// Sends a whole program, with the machine's values that it depends on and leaves; returns its id for a command.
    /// Error: refused, no reply, or a signal to `stop`.
    std::expected<std::uint64_t, Failure> send(const Program& program, const StopSignal* stop = nullptr,
                                               const std::optional<gcode::ProgramValues>& values = {});
    /// Begins a program that is sent while it is made, and while it runs. Every receive() sends what is due, and first
    /// calls `feed` where there is room for more blocks. Returns its id for a command, as soon as the coordinator has
    /// its first blocks. Error: as send().
    using Feed = std::function<void(ProgramSender& sender)>;
    std::expected<std::uint64_t, Failure> stream(const ProgramHead& head,
                                                 const std::optional<gcode::ProgramValues>& values, Feed feed,
                                                 const StopSignal* stop = nullptr);
    /// As stream(), but waits for nothing: the caller appends to the sender and sees from it what the coordinator has
    /// taken. Valid until another program is sent, or close_stream().
    ProgramSender& open_stream(const ProgramHead& head, const std::optional<gcode::ProgramValues>& values = {});
    /// No more is sent of the program.
    void close_stream();
    /// As stream(), without waiting: sender() shows what the coordinator has taken.
    std::uint64_t begin_stream(const ProgramHead& head, const std::optional<gcode::ProgramValues>& values, Feed feed);
    /// Of the program sent last; null: none was.
    const ProgramSender* sender() const { return sender_ ? &*sender_ : nullptr; }

    /// The machine's offsets and tools. Waits until they are received.
    std::expected<RevisedValues, Failure> values();
    /// The newest received; nothing before the first, or where they cannot be read.
    std::optional<RevisedValues> newest_values() const;
    /// Waits until the coordinator has this revision, or a later one, on its disk. Error: it cannot write it, or does
    /// not answer.
    std::expected<void, Failure> await_kept(std::uint64_t revision);
    bool is_kept(std::uint64_t revision) const { return values_ && values_->revision >= revision && values_->on_disk; }

private:
    using Bus = std::variant<ViewerBus, ClientBus>;
    Session(const ChosenMachine& machine, Bus bus);
    ViewerBus& viewer_bus() {
        return std::visit([](ViewerBus& bus) -> ViewerBus& { return bus; }, bus_);
    }
    /// Only of a session with Purpose::Command.
    ClientBus& client_bus() { return std::get<ClientBus>(bus_); }
    bool is_reached();
    void feed_and_send();
    std::expected<void, Failure> await_parts(const std::function<bool()>& done, const StopSignal* stop);

    void take_messages();
    std::chrono::nanoseconds longest_silence() const;
    std::string place_text() const;
    std::string received_axes() const;
    std::string present_axes() const;

    ChosenMachine machine_;
    Bus bus_;
    Identity client_;
    LeaseKeeper lease_;
    std::uint64_t sequence_ = 0;
    std::optional<Received<MachineState>> state_;  // the owner's
    std::optional<Received<MachineState>> standby_;
    std::optional<Reader<PublishedEvent>> events_;
    std::optional<MachineValues> values_;  // the owner's
    std::vector<std::optional<Received<AxisState>>> axes_;
    std::vector<std::optional<AxisHealth>> healths_;
    std::map<std::uint64_t, Reply> replies_;  // to this client, not yet looked at
    std::uint32_t programs_ = 0;              // sent so far
    std::optional<ProgramSender> sender_;     // of the last one
    Feed feed_;
    std::optional<std::chrono::nanoseconds> answered_;  // when it last was
};

}  // namespace lockstep
