// Receives and publishes the messages of an axis's process. It reopens the link to the other processes when the link no
// longer delivers.
#pragma once

#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/protocol/messages.hpp"
#include "core/reused_vector.hpp"
#include "services/runtime/clock.hpp"
#include "services/wire/bus/bus.hpp"
#include "services/wire/bus/clock_link.hpp"
#include "services/wire/dds/watched_link.hpp"

namespace lockstep {

struct AxisLink {
    AxisBus bus;
    std::unique_ptr<ClockClient> clock;  // asks the coordinator for the time
};

/// The messages of one loop.
struct AxisReceived {
    ReusedVector<Frame> frames;
    std::vector<AxisState> states;
    ReusedVector<MachineState> machine;
    std::vector<AxisCommand> commands;
    ReusedVector<Command> requests;
    std::vector<ClockExchange> exchanges;
    void clear();
};

class AxisNetwork {
public:
    struct Setup {
        MachineSetup machine;
        MotorIndex motor;
        Identity identity = 0;
        MachineClock clock;
        Membership membership;
    };
    /// Error: as open_bus.
    static std::expected<AxisNetwork, std::string> open(const Setup& setup);

    /// Returns the messages received since the last call. Empty while the link is being reopened.
    const AxisReceived& receive();
    void publish(const AxisState& state);
    /// Returns the host of another process that publishes as this axis, from DDS discovery. Empty if none is found.
    std::string host_of_rival() const;
    void publish(const AxisHealth& health);

    /// Call it in every loop, with the time of the process's own clock. Reopens the link if it no longer delivers, but
    /// only at rest, and returns the reason.
    std::optional<ReopenReason> tend(Tick now, bool at_rest);
    /// How often the link was reopened since the process started.
    std::uint64_t reopened() const { return link_->reopened(); }

    /// Messages refused since the process started, and why the last ones were refused.
    std::uint64_t refused() const { return refused_before_ + refused_now_; }
    std::string refusals();

private:
    using Link = WatchedLink<AxisLink>;
    AxisNetwork(const Setup& setup, std::unique_ptr<Link> link);
    Reception look(const AxisLink& link, bool at_rest);

    MotorIndex motor_;
    std::unique_ptr<Link> link_;
    AxisReceived received_;
    MotorSet others_;           // other motors that the coordinator reports as present
    MotorSet motors_received_;  // since the last check
    bool machine_received_ = false;
    /// Since the last check.
    struct Acknowledged {
        bool has_published = false;      // a state
        bool is_owner_received = false;  // a state of the owner was received
        bool is_received = false;        // and it says that the owner receives this axis
    } acknowledged_;
    std::vector<TopicReception> topics_;
    std::uint64_t refused_now_ = 0;     // by the link that is open now
    std::uint64_t refused_before_ = 0;  // by the links before it
};

}  // namespace lockstep
