// Makes the notes of an axis's process, only from the inputs and outputs of its controller's step.
#pragma once

#include <vector>

#include "core/axis/axis_controller.hpp"
#include "core/flight/loop_watch.hpp"
#include "core/flight/peer_watch.hpp"

namespace lockstep {

class AxisFlight {
public:
    /// `log` must outlive this object.
    AxisFlight(MotorIndex motor, const MachineConfig& machine, FlightLog& log);

    /// Call it after each step, before orders are converted to the device's time. All times are machine time.
    void take(const AxisInputs& in, const AxisOutputs& out);

private:
    void receive(const AxisInputs& in);
    void receive_owner(Tick now, const MachineState& state);
    void take_order(Tick now, const DeviceOrder& order);
    void take_tracks(const AxisOutputs& out);
    void take_notice(Tick now, const AxisNotice& notice);
    void end_epoch(Tick now);
    void note_state(Tick now, const AxisState& state);

    MotorIndex motor_;
    double ticks_per_second_;
    FlightLog& log_;
    LoopWatch loop_;
    std::vector<PeerWatch> axes_;
    PeerWatch owner_;
    std::optional<MachinePhase> machine_phase_;
    std::uint64_t order_ = 0;                // number of the last order received
    bool has_owner_ = false;                 // has ever followed an owner
    Epoch epoch_ = 0;                        // the last epoch begun
    Epoch touched_ = 0;                      // the last epoch with a touch
    bool own_run_ = false;                   // the device's current run is an own move of the axis
    std::optional<Tick> noted_;              // when the state was last noted
    std::optional<AxisPhase> phase_;         // phase at the last state
    FrameNumber ran_ = 0;                    // the frame of the device's run that has begun
    std::optional<FrameNumber> last_frame_;  // last frame of the epoch, once known
};

}  // namespace lockstep
