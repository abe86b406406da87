// What a coordinator receives and publishes, and its link to the others, which is opened anew when it has ceased to
// deliver.
#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/coordinator/coordinator.hpp"
#include "services/runtime/clock.hpp"
#include "services/wire/bus/bus.hpp"
#include "services/wire/bus/clock_link.hpp"
#include "services/wire/dds/watched_link.hpp"

namespace lockstep {

struct CoordinatorLink {
    CoordinatorBus bus;
    std::unique_ptr<ClockServer> clock;  // where axes ask for the time
};

/// The messages of one loop.
struct CoordinatorReceived {
    std::vector<AxisState> states;
    std::vector<MachineState> others;
    std::vector<Command> commands;
    std::vector<ProgramChunk> chunks;
    std::vector<AxisHealth> healths;  // for the record alone
    void clear();
};

class CoordinatorNetwork {
public:
    struct Setup {
        MachineConfig machine;
        MachineClock clock;
        Membership membership;
    };
    /// Error: as open_bus.
    static std::expected<CoordinatorNetwork, std::string> open(const Setup& setup);

    /// What came since the last call; nothing while the link is being opened anew.
    const CoordinatorReceived& receive();
    void publish(const CoordinatorOutputs& out);
    void publish(const Reply& reply);

    struct Duty {
        bool at_rest = false;
        bool owns_machine = false;  // then every axis reports whether it receives this process
    };
    /// Once in every loop, by the process's own clock. Why the link is being opened anew from now on; only at rest.
    std::optional<ReopenReason> tend(Tick now, Duty duty);
    /// How often since the process started.
    std::uint64_t reopened() const { return link_->reopened(); }

    /// Messages that were not believed, since the process started, and why the last ones were not.
    std::uint64_t refused() const { return refused_before_ + refused_now_; }
    std::string refusals();
    /// Where who is not heard is waited for.
    std::string place_of_states();

private:
    using Link = WatchedLink<CoordinatorLink>;
    CoordinatorNetwork(AxisSet axes, std::unique_ptr<Link> link) : axes_(axes), link_(std::move(link)) {}
    Reception look(const CoordinatorLink& link, Duty duty);

    AxisSet axes_;  // all of the machine
    std::unique_ptr<Link> link_;
    CoordinatorReceived received_;
    AxisSet axes_heard_ = 0;          // since the last look
    bool is_owner_received_ = false;  // since the last look: by an axis
    std::vector<TopicReception> topics_;
    std::uint64_t refused_now_ = 0;     // by the link that is open
    std::uint64_t refused_before_ = 0;  // by those before it
};

}  // namespace lockstep
