// The clock messages of a virtual machine. Axes ask the first coordinator for the machine's time. Each process answers
// and takes them on arrival, not in its loop.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/clock/clock_asker.hpp"
#include "services/virtual/machine_clocks.hpp"
#include "services/virtual/virtual_post.hpp"

namespace lockstep {

class ClockMail {
public:
    /// `post` and `clocks` must outlive this object. `reply_longer`: how much longer replies travel than requests.
    ClockMail(const MachineConfig& machine, VirtualPost& post, const MachineClocks& clocks, Ticks reply_longer);

    /// A new process of the axis asks from now on.
    void begin(MotorIndex motor, Identity identity);
    void ask(MotorIndex motor, Tick now);
    /// The process whose message arrives first; nullopt if none arrives before `limit`.
    std::optional<std::size_t> next(Tick limit) const;
    Tick arrival(std::size_t process) const { return post_.next_arrival(post_.clock_of(process)); }
    /// Takes the messages that have arrived at the process, which loses them unless it is up.
    void take(std::size_t process, Tick now, bool is_up);
    /// The replies to the axis since the last call.
    std::vector<ClockExchange> take_exchanges(MotorIndex motor);

private:
    struct Axis {
        std::optional<ClockAsker> asker;
        std::vector<ClockExchange> exchanges;
    };

    VirtualPost& post_;
    const MachineClocks& clocks_;
    std::int64_t tick_ns_;
    Ticks reply_longer_;
    bool is_used_;
    std::vector<Axis> axes_;
};

}  // namespace lockstep
