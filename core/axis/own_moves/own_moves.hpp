// The moves an axis makes by itself: homing, and from point to point. Each move is one run of the device, or several if
// this process was late with a frame.
#pragma once

#include <cstdint>
#include <optional>

#include "core/axis/own_moves/homing.hpp"
#include "core/axis/own_moves/own_run.hpp"
#include "core/axis/state/axis_loop.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep {

class OwnMoves {
public:
    /// `begin_steps`: its step methods.
    OwnMoves(MotorIndex motor, const MachineConfig& machine, BeginSteps begin_steps);

    bool is_running() const { return run_.has_value(); }

    // Take orders of the owner. `is_resting`: the axis runs nothing, neither its own nor the owner's frames.
    void home(const AxisCommand& order, bool is_resting, AxisLoop& loop);
    void move(const AxisCommand& order, bool is_resting, AxisLoop& loop);
    /// Makes up lost steps. The axis must rest at the order's target, by its count.
    void correct(const AxisCommand& order, bool is_resting, AxisLoop& loop);
    /// Moves towards the target while the order is renewed. The axis rests at the target at the latest.
    void jog(const AxisCommand& order, bool is_resting, AxisLoop& loop);
    /// Takes a repeated order of a jog.
    void renew(const AxisCommand& order, const AxisLoop& loop);
    void halt(AxisLoop& loop);

    // Call these functions while a move is in progress.
    /// Gives the device what it needs next. A fault halts the move.
    void feed(AxisLoop& loop);
    void record(const DeviceStatus& device, AxisLoop& loop) { run_->record(device, loop); }
    /// Call it when the device has ended the run. Ends the order or continues it.
    void end(AxisLoop& loop);
    /// Gives up the order in progress. May be called at any time.
    void abandon();
    HomingStage homing_stage() const { return homing_.stage(); }

private:
    FaultCode refusal_of(const AxisCommand& order, std::int64_t steps, bool is_resting, const AxisLoop& loop) const;
    OwnMove frames_of(const LocalMove& move, Position from, Tick start) const;
    Tick earliest_start(const AxisLoop& loop);
    void start(const LocalMove& move, int tries, AxisLoop& loop);
    void start_jog(const LocalMove& move, Tick until, AxisLoop& loop);
    void take_homing_step(const HomingStep& step, AxisLoop& loop);
    void take_zero(const HomingStep& step, AxisLoop& loop);

    MotorConfig motor_;
    AxisLimits limits_;
    std::int64_t tick_ns_;
    Ticks slot_;
    OwnMove::Lengths lengths_;  // of a frame; a halt waits for its end
    Ticks ahead_;               // how far ahead the device gets frames: longer than a process may stall
    Ticks jog_hold_;
    Ticks jog_frame_;
    Ticks jog_lead_;   // time from the order to the first frame's start
    Ticks half_step_;  // the time of half a step at the start velocity
    /// A rest between two steps, and when a run may start from there.
    struct BetweenSteps {
        Position at;
        Tick start;
    };

    std::optional<BetweenSteps> between_steps_;
    BeginSteps begin_steps_;
    Homing homing_;
    std::optional<OwnRun> run_;
};

}  // namespace lockstep
