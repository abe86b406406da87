// What an axis's process notes: made of the inputs and outputs of its controller's step, and of nothing else.
#pragma once

#include <vector>

#include "core/axis/axis_controller.hpp"
#include "core/flight/loop_watch.hpp"
#include "core/flight/peer_watch.hpp"

namespace lockstep {

class AxisFlight {
public:
    /// `log` outlives it.
    AxisFlight(std::size_t axis, const MachineConfig& machine, FlightLog& log);

    /// After each step: machine time, before anything is put into the device's.
    void take(const AxisInputs& in, const AxisOutputs& out);

private:
    void receive(const AxisInputs& in);
    void receive_owner(Tick now, const MachineState& state);
    void take_order(Tick now, const DeviceOrder& order);
    void take_tracks(const AxisOutputs& out);
    void take_notice(Tick now, const AxisNotice& notice);
    void end_epoch(Tick now);
    void note_state(Tick now, const AxisState& state);

    std::size_t axis_;
    MachineConfig machine_;
    FlightLog& log_;
    LoopWatch loop_;
    std::vector<PeerWatch> axes_;
    PeerWatch owner_;
    std::optional<MachinePhase> machine_phase_;
    std::uint64_t order_ = 0;                // heard last
    bool has_owner_ = false;                 // has ever followed one
    Epoch epoch_ = 0;                        // begun last
    bool own_run_ = false;                   // the device's present run is a move of the axis's own
    std::optional<Tick> noted_;              // when its state was noted last
    std::optional<AxisPhase> phase_;         // then
    FrameNumber ran_ = 0;                    // of the device's run, begun
    std::optional<FrameNumber> last_frame_;  // of the epoch, once it is known
};

}  // namespace lockstep
