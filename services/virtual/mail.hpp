// The messages that a loop received, sorted by type.
#pragma once

#include <vector>

#include "core/reused_vector.hpp"
#include "services/virtual/virtual_network.hpp"

namespace lockstep {

/// Reused for each loop: its lists keep their memory.
class Mail {
public:
    /// Replaces the content by the messages that have arrived at `address` by `now`.
    void collect(VirtualNetwork& network, Tick now, std::size_t address) {
        clear();
        network.receive(now, static_cast<VirtualNetwork::Address>(address), *this);
    }

    ReusedVector<Frame> frames;
    std::vector<AxisState> axes;
    std::vector<MachineState> machine;
    std::vector<AxisCommand> axis_commands;
    std::vector<Command> commands;
    std::vector<ProgramPart> parts;
    std::vector<Reply> replies;
    std::vector<ClockRequest> clock_requests;
    std::vector<ClockReply> clock_replies;

    void operator()(const Frame& m) { frames.push_back(m); }
    void operator()(const AxisState& m) { axes.push_back(m); }
    void operator()(const MachineState& m) { machine.push_back(m); }
    void operator()(const AxisCommand& m) { axis_commands.push_back(m); }
    void operator()(const Command& m) { commands.push_back(m); }
    void operator()(const ProgramPart& m) { parts.push_back(m); }
    void operator()(const Reply& m) { replies.push_back(m); }
    void operator()(const ClockRequest& m) { clock_requests.push_back(m); }
    void operator()(const ClockReply& m) { clock_replies.push_back(m); }

private:
    void clear() {
        frames.clear();
        axes.clear();
        machine.clear();
        axis_commands.clear();
        commands.clear();
        parts.clear();
        replies.clear();
        clock_requests.clear();
        clock_replies.clear();
    }
};

}  // namespace lockstep
