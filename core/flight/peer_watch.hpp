// The notes of a process about another that it receives: silence and return, restarts, vetoes and faults.
#pragma once

#include <optional>

#include "core/flight/flight_event.hpp"
#include "core/machine.hpp"

namespace lockstep {

/// How long a peer must be silent before its silence is noted, and before it counts as lost.
struct SilenceLimits {
    Ticks noted;  // beyond this a check of a frame lacks evidence
    Ticks lost;
};
SilenceLimits silence_limits(const MachineConfig& machine);

class PeerWatch {
public:
    PeerWatch(FlightPeer peer, const SilenceLimits& limits) : peer_(peer), limits_(limits) {}

    struct News {
        Identity identity = 0;
        FaultCode fault = FaultCode::None;
        Epoch epoch = 0;
        std::optional<FrameNumber> veto;
    };
    void receive(Tick now, const News& news, FlightLog& log);
    /// Call it after this loop's messages were received. `missed`: how long this process itself did not run and
    /// received nothing.
    void look(Tick now, Ticks missed, FlightLog& log);

private:
    void receive_identity(Tick now, Identity identity, FlightLog& log);
    IncidentReason lost() const {
        return peer_.kind == FlightPeer::Kind::Coordinator ? IncidentReason::OwnerLost : IncidentReason::AxisLost;
    }

    FlightPeer peer_;
    SilenceLimits limits_;
    std::optional<News> last_;
    Tick received_;
    bool is_silent_ = false;  // and the silence is noted
    bool is_lost_ = false;    // and the loss was reported as an incident
};

}  // namespace lockstep
