// The data of one loop of the coordinator: a view for all its parts, outputs for those that publish, and orders to axes
// for those that begin, end or fail a job.
#pragma once

#include <string>

#include "core/coordinator/axes/axis_orders.hpp"
#include "core/coordinator/axes/axis_roster.hpp"
#include "core/coordinator/program/program_store.hpp"
#include "core/coordinator/state/coordinator_io.hpp"
#include "core/indices.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/machine.hpp"

namespace lockstep {

/// The inputs and the state that all parts may read.
struct LoopView {
    const MachineConfig& machine;
    const Kinematics& kinematics;
    const AxisRoster& axes;
    const ProgramStore& programs;
    Tick now;
    Slot slot = 0;
    Slot next_state = 0;   // the slot of the next state that it publishes
    Term term;             // the coordinator's own, if it owns the machine
    bool is_late = false;  // the process stalled, so messages received in this loop may be old

    /// Where the axes are, in whole steps.
    AxisCounts counts() const { return kinematics.axes_at(axes.counts()); }
    /// The plays of all motors; none if no motor has backlash.
    AxisCounts plays() const {
        AxisCounts plays;
        if (!has_backlash(machine)) { return plays; }
        for (const AxisView& view : axes.views()) { plays.append(view.state ? view.state->play_steps : 0); }
        return plays;
    }
    /// How messages to people name a motor.
    std::string label_of(MotorIndex motor) const { return kinematics.label(motor); }
};

/// The same, with the loop's outputs.
struct PublishingLoop : LoopView {
    CoordinatorOutputs& out;

    void notice(const CoordinatorNotice& notice) { out.notices.push_back(notice); }
};

/// The same, with the orders to axes.
struct CoordinatorLoop : PublishingLoop {
    AxisOrders& orders;

    AxisCommand& order(MotorIndex motor, AxisCommandKind kind) { return orders.give(motor, kind, term); }
    void order_each(MotorSet motors, AxisCommandKind kind) {
        for (const MotorIndex motor : motors) { (void)order(motor, kind); }
    }
    bool is_order_done(MotorIndex motor) const { return orders.is_done(motor, axes); }
};

}  // namespace lockstep
