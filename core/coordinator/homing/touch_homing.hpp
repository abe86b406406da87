// Homes an axis whose switch cannot end the pulses of its motors, because it is wired to another device or because
// motors of several devices move the axis. The sequence is that of an axis that homes by itself, but its moves are
// paths of all axes that end at a touch of the switch's input (docs/decisions/motion/homing-by-touch.md).
//
// The place of the axis is not known, and each path must lie within its travel. So before each move the axis is assumed
// to be at the end of its travel from which the move leads to the other one.
#pragma once

#include <cstdint>
#include <optional>

#include "core/axis/own_moves/homing.hpp"
#include "core/coordinator/homing/assumed_place.hpp"
#include "core/coordinator/state/coordinator_loop.hpp"
#include "core/program.hpp"

namespace lockstep {

/// Names the motors of all axes that home by touch.
MotorSet motors_homed_by_touch(AxisSet axes, const LoopView& loop);
AxisSet axes_homed_by_touch(AxisSet axes, const MachineConfig& machine);

class TouchHoming {
public:
    TouchHoming(AxisIndex axis, const MachineConfig& machine);

    AxisIndex axis() const { return axis_; }
    HomingStage stage() const { return homing_.stage(); }

    enum class Next : std::uint8_t {
        Wait,    // until the state of the switch is known
        Assume,  // order the motors of the axis to assume places(); a move follows
        Move,    // run program()
        End,     // the same, and these places are true: homing by touch is done
        Fail,    // with fault()
    };
    /// Returns what to do next. Call it only while nothing moves and no order is open.
    Next next(const LoopView& loop);
    /// Where the motors are assumed to be, or truly are. Only motors of the axis change.
    const MotorCounts& places() const { return places_; }
    FaultCode fault() const { return fault_; }

    /// The next move, from where the axes are assumed to be.
    Program program(const LoopView& loop);
    /// Call it when this move has ended at rest. `probe`: the result of a move that ends at a touch.
    void moved(const std::optional<ProbeResult>& probe, const LoopView& loop);

private:
    bool is_closed(const LoopView& loop) const;
    bool is_switch_known(const LoopView& loop) const;
    bool take(const HomingStep& step);
    std::int64_t end_of_travel(bool upper) const;
    std::int64_t touch_error(const LoopView& loop) const;

    AxisIndex axis_;
    AxisConfig config_;
    std::size_t input_;  // of the machine
    TouchInput switch_;
    Homing homing_;
    bool has_begun_ = false;
    std::optional<LocalMove> move_;  // in progress
    std::int64_t left_ = 0;          // steps of it
    bool is_placed_ = false;         // for its next part
    std::int64_t from_ = 0;          // where this part begins, and its target, as assumed
    std::int64_t to_ = 0;
    std::int64_t at_ = 0;    // from where homing began
    std::int64_t zero_ = 0;  // the same, at the axis's true zero, once it is known
    AssumedPlace assumed_;
    MotorCounts places_;
    LocalEnd end_;  // of the last move
    std::optional<Slot> rested_;
    FaultCode fault_ = FaultCode::None;
};

}  // namespace lockstep
