// What each role hears and says, as one value. Members are made in order on the participant.
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

/// Lets a thread sleep until something has come.
class Arrivals {
public:
    void notify();
    /// True: something came since the last call. False: the time passed.
    bool wait_for(std::chrono::nanoseconds time);

private:
    std::mutex mutex_;
    std::condition_variable condition_;
    bool arrived_ = false;
};

struct AxisBus {
    Participant participant;
    Reader<Frame> frames{participant};
    StatesHeard states{participant};  // the other axes'
    Reader<MachineState> machine{participant};
    Reader<AxisCommand> commands{participant};
    Reader<Command> requests{participant};  // clients', to the coordinator
    StateSaid state{participant};
    Writer<AxisHealth> health{participant};

    bool is_memory_replaced() const { return states.is_memory_replaced() || state.is_memory_replaced(); }
};

struct CoordinatorBus {
    Participant participant;
    StatesHeard states{participant};
    Reader<AxisHealth> healths{participant};  // for the record alone
    Reader<MachineState> other_coordinators{participant};
    Reader<Command> commands{participant};
    Reader<ProgramChunk> chunks{participant};
    Writer<Frame> frames{participant};
    Writer<MachineState> machine{participant};
    Writer<AxisCommand> axis_commands{participant};
    Writer<Reply> replies{participant};

    bool is_memory_replaced() const { return states.is_memory_replaced(); }
};

/// What has become other than it was when the bus was opened.
template <typename Bus>
std::optional<ReopenReason> change_of(const Bus& bus) {
    if (bus.participant.has_interface_changed()) { return ReopenReason::InterfaceChanged; }
    if (bus.is_memory_replaced()) { return ReopenReason::MemoryReplaced; }
    return std::nullopt;
}

/// What one hears who looks on.
struct ViewerBus {
    Participant participant;
    std::unique_ptr<Arrivals> arrivals = std::make_unique<Arrivals>();  // of machine states, and of a client's replies
    Reader<MachineState> machine{participant, [to = arrivals.get()] { to->notify(); }};
    Reader<AxisState> states{participant};
    Reader<AxisHealth> healths{participant};
};

struct ClientBus : ViewerBus {
    Reader<Reply> replies{participant, [to = arrivals.get()] { to->notify(); }};
    Writer<Command> commands{participant};
    Writer<ProgramChunk> chunks{participant};
};

/// Error: the participant's, or the first topic's that could not be opened.
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
