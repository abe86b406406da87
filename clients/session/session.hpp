// A client's conversation with a machine: what it hears of coordinator and axes, what it asks, and the answers.
#pragma once

#include <chrono>
#include <expected>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "clients/session/chosen_machine.hpp"
#include "clients/text/failure.hpp"
#include "core/program.hpp"
#include "core/protocol/axis_health.hpp"
#include "core/protocol/messages.hpp"
#include "services/runtime/stop_signal.hpp"
#include "services/wire/bus/bus.hpp"
#include "services/wire/dds/present_processes.hpp"

namespace lockstep {

inline constexpr std::chrono::seconds kReachPatience{3};

template <typename State>
struct Heard {
    State state;
    std::chrono::nanoseconds time;  // CLOCK_MONOTONIC of this host
};

/// What a session is for: where security is on, it takes the keys of a viewer or of a client.
enum class Purpose { Look, Command };

class Session {
public:
    /// On the machine's network; hears nobody yet. Error: DDS cannot be opened, or security does not let it in.
    static std::expected<Session, Failure> join(const ChosenMachine& machine, Purpose purpose);
    /// join, and reach.
    static std::expected<Session, Failure> open(const ChosenMachine& machine, Purpose purpose);

    /// Waits until a coordinator speaks and listens. Error: none does; who is heard at all, and what to do.
    std::expected<void, Failure> reach(std::chrono::nanoseconds patience = kReachPatience);
    /// Waits until every axis is heard. Error: who is not.
    std::expected<void, Failure> reach_axes();
    /// Waits for the axes that the coordinator hears, and a moment for the others: who is not heard then is not there.
    void await_axes();
    /// Waits, at most so long, for the live figures of every axis that is heard: they come ten times a second.
    void await_healths(std::chrono::nanoseconds patience);

    /// Sleeps until something comes, at most so long, and takes it.
    void listen(std::chrono::nanoseconds at_most);

    const MachineConfig& config() const { return machine_.config; }
    /// Of another configuration than the client's: its places and limits are not to be relied on.
    bool config_differs() const { return state_ && state_->state.config_hash != machine_.hash; }

    /// The newest heard; nothing before the first.
    const std::optional<Heard<MachineState>>& state() const { return state_; }
    const std::optional<Heard<AxisState>>& axis(std::size_t i) const { return axes_[i]; }
    const std::optional<AxisHealth>& health(std::size_t i) const { return healths_[i]; }
    /// Whether it was heard within the time after which the machine counts it as gone.
    bool axis_present(std::size_t i) const;
    /// Whether a coordinator that stands by is heard.
    bool has_standby() const;
    /// No state of the coordinator for longer than any stall that the machine's timing allows.
    bool is_silent() const;
    Failure silent() const;
    /// The machine's processes on the network, also those that say nothing yet.
    std::vector<PresentProcess> present() const;

    /// Asks until the answer comes; who asks is filled in. Error: none comes, or not soon after a signal to `stop`.
    std::expected<Reply, Failure> command(Command command, const StopSignal* stop = nullptr);
    /// Calls out to coordinator and axes alike: axes stop by themselves. Nothing: no coordinator answered in the time.
    std::optional<Reply> stop_at_once(std::chrono::nanoseconds patience);
    /// Sends a program; what it is called in a command. Error: it is refused, no answer comes, or a signal to `stop`.
    std::expected<std::uint64_t, Failure> send(const Program& program, const StopSignal* stop = nullptr);

private:
    using Bus = std::variant<ViewerBus, ClientBus>;
    Session(const ChosenMachine& machine, Bus bus);
    ViewerBus& heard() {
        return std::visit([](ViewerBus& bus) -> ViewerBus& { return bus; }, bus_);
    }
    /// Only of a session that is to command.
    ClientBus& asking() { return std::get<ClientBus>(bus_); }
    bool is_reached();

    void take();
    std::chrono::nanoseconds longest_silence() const;
    std::string whereabouts() const;
    std::string axes_heard() const;
    std::string axes_there() const;

    ChosenMachine machine_;
    Bus bus_;
    Identity client_;
    std::uint64_t sequence_ = 0;
    std::optional<Heard<MachineState>> state_;  // the owner's
    std::optional<Heard<MachineState>> standby_;
    std::vector<std::optional<Heard<AxisState>>> axes_;
    std::vector<std::optional<AxisHealth>> healths_;
    std::map<std::uint64_t, Reply> replies_;  // to this client, not yet looked at
};

}  // namespace lockstep
