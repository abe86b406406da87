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
#include "clients/session/follow/command_tracker.hpp"
#include "clients/session/follow/owner_watch.hpp"
#include "clients/session/lease/lease_keeper.hpp"
#include "clients/session/program_sender.hpp"
#include "clients/text/failure.hpp"
#include "core/gcode/kept_values.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/program.hpp"
#include "core/protocol/axis_health.hpp"
#include "core/protocol/messages.hpp"
#include "services/documents/values/values_document.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/stop_signal.hpp"
#include "services/wire/bus/bus.hpp"
#include "services/wire/dds/present_processes.hpp"

namespace lockstep {

inline constexpr std::chrono::seconds kReachPatience{3};

/// With security, a Look session uses a viewer's keys, a Command session a client's.
enum class Purpose { Look, Command };

class Session {
public:
    /// Joins the machine's network; nothing is received yet. Fails if DDS cannot be opened, or security refuses the
    /// client.
    static std::expected<Session, Failure> join(const ChosenMachine& machine, Purpose purpose);
    /// join() and reach().
    static std::expected<Session, Failure> open(const ChosenMachine& machine, Purpose purpose);

    /// Waits until a coordinator publishes states and is matched with this client. If none does, the error names the
    /// axes that are received, and the remedy.
    std::expected<void, Failure> reach(std::chrono::nanoseconds patience = kReachPatience);
    /// Waits until every axis is received. The error names an axis that is not.
    std::expected<void, Failure> reach_axes();
    /// Waits for the axes that the coordinator receives, and briefly for the others. Axes that are still missing count
    /// as absent.
    void await_axes();
    /// Waits for the live figures of every received axis; axes publish them ten times a second.
    void await_healths(std::chrono::nanoseconds patience);

    /// Subscribes to events of programs, and waits until they are received from every coordinator. Fails if that takes
    /// longer.
    std::expected<void, Failure> follow_events(std::chrono::nanoseconds patience);
    /// Returns the events received since the last call, oldest first. A slow reader may miss events: see
    /// PublishedEvent::sequence.
    std::vector<PublishedEvent> take_events();
    /// Waits for messages and processes them.
    void receive(std::chrono::nanoseconds at_most);
    /// Receives until done() returns true, at most for `patience` of running_time(). Returns whether it did.
    template <typename Done>
    bool receive_until(std::chrono::nanoseconds patience, Done done) {
        const std::chrono::nanoseconds deadline = running_time() + patience;
        while (!done()) {
            if (running_time() >= deadline) { return false; }
            receive(std::chrono::milliseconds{20});
        }
        return true;
    }

    /// The time for which this client has looked for messages. Time in which it was itself stopped does not count.
    std::chrono::nanoseconds running_time() const { return owner_.running_time(); }
    /// Returns once how long this client was stopped, as soon as it has received the coordinator again; else nullopt.
    std::optional<std::chrono::nanoseconds> take_stall() { return owner_.take_stall(); }

    const MachineConfig& config() const { return machine_.config; }
    /// True if the coordinator runs another configuration than the client has; its positions and limits may differ.
    bool config_differs() const { return state() && state()->state.config_hash != machine_.hash; }

    /// The newest one received; nullopt before the first.
    const std::optional<Received<MachineState>>& state() const { return owner_.state(); }
    const Kinematics& kinematics() const { return kinematics_; }
    /// The newest state of a motor, of an axis by its motors (axis_state_of), and the axis's speed in steps per tick.
    const std::optional<Received<AxisState>>& motor(std::size_t i) const { return motors_[i]; }
    const std::optional<Received<AxisState>>& axis(std::size_t i) const { return axes_[i]; }
    double axis_speed(std::size_t i) const;
    /// Of a motor.
    const std::optional<AxisHealth>& health(std::size_t motor) const { return healths_[motor]; }
    /// Whether a state came within the time after which the machine counts a motor as absent.
    bool motor_present(std::size_t i) const { return is_recent(motors_[i]); }
    /// The same of all motors that the axis's place needs.
    bool axis_present(std::size_t i) const { return is_recent(axes_[i]); }
    /// Whether a standby coordinator is received.
    bool has_standby() const;
    /// True if no state of the coordinator came for longer than any stall that the machine's timing allows, while this
    /// client looked for one.
    bool is_silent() const { return sight().is_silent; }
    OwnerSight sight() const { return owner_.sight(); }
    Failure silent() const;
    /// The machine's processes on the network, also those that publish nothing yet.
    std::vector<PresentProcess> present() const;

    /// Follows the command until its answer comes. Fails if none comes in time, or none soon after a signal to `stop`.
    /// An emergency stop also goes to the axes, which stop without the coordinator.
    std::expected<Reply, Failure> command(const Command& command, const StopSignal* stop = nullptr,
                                          std::chrono::nanoseconds patience = CommandTracker::kPatience);
    /// The same without waiting; call it in each loop until the command is over. Sends the command when that is due.
    CommandStep follow(CommandTracker& tracker);
    // One writer at a time may move and change the machine: while a writer holds the lease, only its commands are
    // accepted. While nobody holds it, the commands of every client are accepted.
    /// Sets the writer of all later commands. Give the lease back first. An id of 0 stands for this client's identity,
    /// which no other client shares.
    void write_as(LeaseHolder writer) { lease_.write_as(std::move(writer)); }
    const LeaseKeeper& lease() const { return lease_; }
    /// See LeaseKeeper::use(). receive() keeps the lease: a client that does not receive for kLeaseSilence_ms loses it.
    void use_lease(const LeaseUse& use);
    /// Requests the lease and waits for the reply, which refuses it if another writer has it. `takes_over` takes it
    /// from that writer. Fails like command().
    std::expected<Reply, Failure> take_lease(bool takes_over = false, const StopSignal* stop = nullptr);
    /// Gives the lease back and waits at most `patience` for the coordinator's answer. Sends nothing without the lease.
    void give_lease(std::chrono::nanoseconds patience = {});
    /// The writer that the coordinator publishes, this client's or another. Null if there is none, or nothing is
    /// received yet.
    const HeldLease* writer() const { return state() && state()->state.lease ? &*state()->state.lease : nullptr; }

    /// Sends a whole program, with the machine's values that it depends on and leaves. Returns its id for a command.
    /// Fails if it is refused, if no reply comes, or at a signal to `stop`.
    std::expected<std::uint64_t, Failure> send(const Program& program, const StopSignal* stop = nullptr,
                                               const std::optional<gcode::ProgramValues>& values = {});
    /// Begins a program that is sent while it is being made and while it runs. Every receive() calls `feed` if there is
    /// room for more blocks, then sends what is due. Returns the program's id for a command, as soon as the coordinator
    /// has its first blocks. Fails like send().
    using Feed = std::function<void(ProgramSender& sender)>;
    std::expected<std::uint64_t, Failure> stream(const ProgramHead& head,
                                                 const std::optional<gcode::ProgramValues>& values, Feed feed,
                                                 const StopSignal* stop = nullptr);
    /// Like stream(), but does not wait and has no feed: the caller appends to the sender, which shows what the
    /// coordinator has taken. The sender is valid until another program is sent, or close_stream().
    ProgramSender& open_stream(const ProgramHead& head, const std::optional<gcode::ProgramValues>& values = {});
    /// Sends no more of the program.
    void close_stream();
    /// Like stream(), without waiting: sender() shows what the coordinator has taken.
    std::uint64_t begin_stream(const ProgramHead& head, const std::optional<gcode::ProgramValues>& values, Feed feed);
    /// The sender of the last program; null if none was sent.
    const ProgramSender* sender() const { return sender_ ? &*sender_ : nullptr; }

    /// The machine's offsets and tools. Waits until they are received.
    std::expected<RevisedValues, Failure> values();
    /// The newest values received; nullopt before the first, or if they cannot be read.
    std::optional<RevisedValues> newest_values() const;
    /// Waits until the coordinator reports that this revision, or a later one, is on its disk. Fails if it does not
    /// report that in time.
    std::expected<void, Failure> await_kept(std::uint64_t revision);
    /// Since when the values that are received, offsets and tools, are not on the coordinator's disk; nullopt: they
    /// are, or none are received. After a change this lasts some milliseconds.
    std::optional<std::chrono::nanoseconds> values_unsaved_since() const { return unsaved_since_; }
    /// Returns at once if values are received, otherwise waits at most `patience`.
    void await_values(std::chrono::nanoseconds patience);
    bool is_kept(std::uint64_t revision) const { return values_ && values_->revision >= revision && values_->on_disk; }

private:
    using Bus = std::variant<ViewerBus, ClientBus>;
    Session(const ChosenMachine& machine, Bus bus);
    ViewerBus& viewer_bus() {
        return std::visit([](ViewerBus& bus) -> ViewerBus& { return bus; }, bus_);
    }
    /// Only for a session with Purpose::Command.
    ClientBus& client_bus() { return std::get<ClientBus>(bus_); }
    bool is_reached();
    void feed_and_send();
    std::expected<void, Failure> await_parts(const std::function<bool()>& done, const StopSignal* stop);

    void keep_lease();
    void write(const Command& command) { (void)client_bus().commands.write(command); }
    void take_messages();
    void take_replies();
    std::string place_text() const;
    bool is_recent(const std::optional<Received<AxisState>>& state) const;
    void take(AxisState&& state, std::chrono::nanoseconds now);
    std::vector<const AxisState*> motor_states() const;
    std::string received_axes() const;
    std::string present_axes() const;

    ChosenMachine machine_;
    Bus bus_;
    Identity client_;
    LeaseKeeper lease_;
    std::uint64_t sequence_ = 0;
    OwnerWatch owner_;
    std::optional<Received<MachineState>> standby_;
    std::optional<Reader<PublishedEvent>> events_;
    std::optional<MachineValues> values_;  // the owner's
    std::optional<std::chrono::nanoseconds> unsaved_since_;
    Kinematics kinematics_;
    std::vector<std::optional<Received<AxisState>>> motors_;
    std::vector<std::optional<Received<AxisState>>> axes_;  // by their motors
    std::vector<AxisSet> needed_;                           // of each axis: motors_needed_for
    std::vector<std::optional<AxisHealth>> healths_;
    std::map<std::uint64_t, Reply> replies_;  // to this client, not read yet
    std::uint32_t programs_ = 0;              // sent so far
    std::optional<ProgramSender> sender_;     // of the last program
    Feed feed_;
    std::optional<std::chrono::nanoseconds> answered_;  // running_time() at the coordinator's last answer to sender_
};

}  // namespace lockstep
