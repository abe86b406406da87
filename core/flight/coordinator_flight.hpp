// What a coordinator's process notes: made of the inputs and outputs of its step, and of nothing else.
#pragma once

#include <vector>

#include "core/coordinator/coordinator.hpp"
#include "core/flight/loop_watch.hpp"
#include "core/flight/peer_watch.hpp"

namespace lockstep {

class CoordinatorFlight {
public:
    /// `log` outlives it.
    CoordinatorFlight(const MachineConfig& machine, FlightLog& log);

    /// After each step.
    void take(const CoordinatorInputs& in, const CoordinatorOutputs& out);

private:
    void receive(const CoordinatorInputs& in);
    void take_notice(Tick now, const CoordinatorNotice& notice);
    void take_job(Tick now, const JobEvent& job);
    void send(Tick now, const CoordinatorOutputs& out);
    void note_state(Tick now, const MachineState& state);

    MachineConfig machine_;
    FlightLog& log_;
    LoopWatch loop_;
    std::vector<PeerWatch> axes_;
    PeerWatch other_owner_;
    bool knew_owner_ = false;  // before itself
    Identity client_ = 0;      // whose command was heard last, and which
    std::uint64_t command_ = 0;
    Epoch epoch_ = 0;  // of the frame sent last
    FrameNumber sent_ = 0;
    std::vector<std::uint64_t> orders_;  // sent last to each axis
    std::optional<Tick> noted_;
    std::optional<MachinePhase> phase_;
};

}  // namespace lockstep
