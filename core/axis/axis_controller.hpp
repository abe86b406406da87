// One axis, as a state machine with messages and time as inputs. Everything happens in `step`.
//
// In each loop it gets the time, one reading of its device, and every received message. It returns orders for the
// device, its state once a slot, and a record of what was run. It does no I/O and reads no clock.
#pragma once

#include "core/axis/following/epoch_following.hpp"
#include "core/axis/following/owner_link.hpp"
#include "core/axis/own_moves/own_moves.hpp"
#include "core/axis/state/axis_io.hpp"
#include "core/axis/state/axis_loop.hpp"
#include "core/axis/state/client_stops.hpp"
#include "core/axis/state/encoder_watch.hpp"
#include "core/axis/state/rest_outputs.hpp"
#include "core/axis/state/speed_trend.hpp"
#include "core/protocol/slot_gate.hpp"

namespace lockstep {

class AxisController {
public:
    /// `identity` is new at every start of the process. `begin_steps`: the methods of the axis's own moves. `kept`: the
    /// position that the previous process kept.
    AxisController(MotorIndex motor, const MachineConfig& machine, Identity identity, std::uint64_t config_hash,
                   BeginSteps begin_steps, KeptOrNot kept);

    /// Valid until the next step.
    const AxisOutputs& step(const AxisInputs& inputs);

    AxisPhase phase() const { return condition_.phases.phase(); }
    bool homed() const { return condition_.position.homed(); }
    bool at_rest() const { return is_resting() && !device_.status().moving; }
    /// How often each row of kAxisTransitions has been taken.
    const TransitionCounts& transitions() const { return condition_.phases.transitions(); }
    /// Machine coordinates are the device's counts minus this.
    std::int64_t zero_count() const { return condition_.position.zero_count(); }

private:
    // These process the device's actions since the last loop.
    void look(const AxisInputs& inputs, AxisLoop& loop);
    void release();
    void find_device(const AxisInputs& inputs, AxisLoop& loop);
    void lose_device(AxisLoop& loop);
    void observe_run(AxisLoop& loop);
    void follow_speed();
    void end_run(AxisLoop& loop);
    void end_by_emergency(AxisLoop& loop);
    void check_encoder(AxisLoop& loop);
    void check_stop_inputs(AxisLoop& loop);

    // Messages.
    void receive(const AxisInputs& inputs, AxisLoop& loop);
    void receive(const MachineState& state, AxisLoop& loop);
    void carry_out(const AxisCommand& order, AxisLoop& loop);
    void stop_now(FaultCode why, AxisLoop& loop);
    void reset(const AxisCommand& order, AxisLoop& loop);

    void move_on(AxisLoop& loop);
    void tend_outputs(AxisLoop& loop);
    void publish(const AxisInputs& inputs, AxisLoop& loop);
    AxisState state(const AxisLoop& loop, Ticks clock_error) const;
    bool is_stop_closed() const { return (device_.status().inputs & stop_inputs_) != 0; }
    /// The axis runs neither its own nor the owner's frames.
    bool is_resting() const { return !following_.is_open() && !own_.is_running(); }

    MotorIndex motor_;
    Identity identity_;
    std::uint64_t config_hash_;
    Ticks slot_;
    std::uint32_t stop_inputs_;
    AxisCondition condition_;
    DeviceView device_;
    OwnerLink owner_;
    ClientStops stops_;
    EpochFollowing following_;
    OwnMoves own_;
    RestOutputs outputs_;
    SpeedTrend trend_;
    EncoderWatch encoder_;
    SlotGate gate_;
    AxisOutputs out_;
};

}  // namespace lockstep
