// Makes the notes of a coordinator's process, only from the inputs and outputs of its step.
#pragma once

#include <vector>

#include "core/coordinator/state/coordinator_io.hpp"
#include "core/flight/loop_watch.hpp"
#include "core/flight/peer_watch.hpp"
#include "core/protocol/client_memory.hpp"

namespace lockstep {

class CoordinatorFlight {
public:
    /// `log` must outlive this object.
    CoordinatorFlight(const MachineConfig& machine, FlightLog& log);

    /// Call it after each step.
    void take(const CoordinatorInputs& in, const CoordinatorOutputs& out);

private:
    /// The sequences of a client's last commands.
    struct LastCommands {
        std::uint64_t about_lease = 0;
        std::uint64_t other = 0;
    };

    void receive(const CoordinatorInputs& in);
    void receive_command(Tick now, const Command& command);
    void take_notice(Tick now, const CoordinatorNotice& notice);
    void take_job(Tick now, const JobEvent& job);
    void send(Tick now, const CoordinatorOutputs& out);
    void note_state(Tick now, const MachineState& state);

    double ticks_per_second_;
    FlightLog& log_;
    LoopWatch loop_;
    std::vector<PeerWatch> axes_;
    PeerWatch other_owner_;
    bool knew_owner_ = false;  // has received another owner
    ClientMemory<LastCommands> commands_;
    Epoch epoch_ = 0;  // epoch of the last frame sent
    FrameNumber sent_ = 0;
    std::vector<std::uint64_t> orders_;  // number of the last order sent to each axis
    std::optional<Tick> noted_;
    std::optional<MachinePhase> phase_;
};

}  // namespace lockstep
