// Receives and publishes a coordinator's messages. It reopens the link to the other processes when the link no longer
// delivers.
#pragma once

#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/coordinator/coordinator.hpp"
#include "core/reused_vector.hpp"
#include "services/runtime/clock.hpp"
#include "services/wire/bus/bus.hpp"
#include "services/wire/bus/clock_link.hpp"
#include "services/wire/dds/watched_link.hpp"

namespace lockstep {

struct CoordinatorLink {
    CoordinatorBus bus;
    std::unique_ptr<ClockServer> clock;  // axes ask it for the time
};

/// The messages of one loop.
struct CoordinatorReceived {
    std::vector<AxisState> states;
    ReusedVector<MachineState> others;
    ReusedVector<Command> commands;
    std::vector<ProgramChunk> chunks;
    std::vector<AxisHealth> healths;    // only for the record
    std::vector<MachineValues> values;  // of other coordinators
    void clear();
};

class CoordinatorNetwork {
public:
    struct Setup {
        MachineSetup machine;
        MachineClock clock;
        Membership membership;
    };
    /// Error: as open_bus.
    static std::expected<CoordinatorNetwork, std::string> open(const Setup& setup);

    /// Returns the messages received since the last call. Empty while the link is being reopened.
    const CoordinatorReceived& receive();
    void publish(const CoordinatorOutputs& out);
    void publish(const Reply& reply);
    void publish(const MachineValues& values);

    struct Duty {
        bool at_rest = false;
        bool owns_machine = false;  // then every axis reports whether it receives this process's messages
    };
    /// Call it in every loop, with the time of the process's own clock. Reopens the link if it no longer delivers, but
    /// only at rest, and returns the reason.
    std::optional<ReopenReason> tend(Tick now, Duty duty);
    /// How often the link was reopened since the process started.
    std::uint64_t reopened() const { return link_->reopened(); }

    /// Messages refused since the process started, and why the last ones were refused.
    std::uint64_t refused() const { return refused_before_ + refused_now_; }
    std::string refusals();
    /// Where the states of a missing axis are expected.
    std::string place_of_states();

private:
    using Link = WatchedLink<CoordinatorLink>;
    CoordinatorNetwork(const MachineSetup& machine, std::unique_ptr<Link> link);
    Reception look(const CoordinatorLink& link, Duty duty);

    MotorSet motors_;  // all of the machine
    std::unique_ptr<Link> link_;
    CoordinatorReceived received_;
    MotorSet motors_received_;        // since the last check
    bool is_owner_received_ = false;  // since the last check, an axis received the owner
    std::vector<TopicReception> topics_;
    std::uint64_t refused_now_ = 0;     // by the link that is open now
    std::uint64_t refused_before_ = 0;  // by the links before it
};

}  // namespace lockstep
