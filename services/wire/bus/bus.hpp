// One struct for each role, with the topics that it reads and writes. The members are constructed in order, on the
// participant.
#pragma once

#include <chrono>
#include <condition_variable>
#include <expected>
#include <memory>
#include <mutex>
#include <string>

#include "services/wire/bus/axis_states.hpp"
#include "services/wire/bus/endpoints.hpp"

namespace lockstep {

/// Lets a thread sleep until something is received.
class Arrivals {
public:
    void notify();
    /// Returns true if something was received since the last call, false if the time passed.
    bool wait_for(std::chrono::nanoseconds time);

private:
    std::mutex mutex_;
    std::condition_variable condition_;
    bool arrived_ = false;
};

struct AxisBus {
    Participant participant;
    Reader<Frame> frames{participant};
    AxisStatesReader states{participant};  // of the other axes
    Reader<MachineState> machine{participant};
    Reader<AxisCommand> commands{participant};
    Reader<Command> requests{participant};  // from clients to the coordinator
    AxisStateWriter state{participant};
    Writer<AxisHealth> health{participant};

    bool is_memory_replaced() const { return states.is_memory_replaced() || state.is_memory_replaced(); }
};

struct CoordinatorBus {
    Participant participant;
    AxisStatesReader states{participant};
    Reader<AxisHealth> healths{participant};  // only for the record
    Reader<MachineState> other_coordinators{participant};
    Reader<Command> commands{participant};
    Reader<ProgramChunk> chunks{participant};
    Reader<MachineValues> other_values{participant};
    Writer<Frame> frames{participant};
    Writer<MachineState> machine{participant};
    Writer<AxisCommand> axis_commands{participant};
    Writer<Reply> replies{participant};
    Writer<PublishedEvent> events{participant};
    Writer<MachineValues> values{participant};

    bool is_memory_replaced() const { return states.is_memory_replaced(); }
};

/// Returns what has changed since the bus was opened, as a reason to reopen it.
template <typename Bus>
std::optional<ReopenReason> change_of(const Bus& bus) {
    if (bus.participant.has_interface_changed()) { return ReopenReason::InterfaceChanged; }
    if (bus.is_memory_replaced()) { return ReopenReason::MemoryReplaced; }
    return std::nullopt;
}

/// Topics of a read-only observer.
struct ViewerBus {
    Participant participant;
    std::unique_ptr<Arrivals> arrivals = std::make_unique<Arrivals>();  // machine states, and a client's replies
    Reader<MachineState> machine{participant, [to = arrivals.get()] { to->notify(); }};
    Reader<AxisState> states{participant};
    Reader<AxisHealth> healths{participant};
    Reader<MachineValues> values{participant};
};

struct ClientBus : ViewerBus {
    Reader<Reply> replies{participant, [to = arrivals.get()] { to->notify(); }};
    Writer<Command> commands{participant};
    Writer<ProgramChunk> chunks{participant};
};

/// Error: the participant's error, or the first topic that could not be opened.
template <typename Bus>
std::expected<Bus, std::string> open_bus(const NetworkConfig& network, const std::string& machine,
                                         const Membership& membership = {}) {
    auto participant = Participant::open(network, machine, membership);
    if (!participant) { return std::unexpected(participant.error()); }
    Bus bus{std::move(*participant)};
    if (const auto& failure = bus.participant.failure()) { return std::unexpected(*failure); }
    return bus;
}

}  // namespace lockstep
