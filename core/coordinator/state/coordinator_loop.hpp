// The data that the parts of the coordinator share in one loop: the time, the machine, its axes and condition, and the
// loop's outputs.
#pragma once

#include <string>

#include "core/coordinator/axes/axis_orders.hpp"
#include "core/coordinator/axes/axis_roster.hpp"
#include "core/coordinator/program/program_store.hpp"
#include "core/coordinator/state/coordinator_io.hpp"
#include "core/coordinator/state/machine_condition.hpp"
#include "core/machine.hpp"

namespace lockstep {

struct CoordinatorLoop {
    const MachineConfig& machine;
    AxisRoster& axes;
    AxisOrders& orders;
    const ProgramStore& programs;
    MachineCondition& condition;
    CoordinatorOutputs& out;
    Tick now;
    Slot slot = 0;
    Slot next_state = 0;   // the slot of the next state that it publishes
    Term term;             // the coordinator's own, if it owns the machine
    bool is_late = false;  // the process stalled, so messages received in this loop may be old

    void notice(const CoordinatorNotice& notice) { out.notices.push_back(notice); }
    void enter(MachinePhase phase) { condition.enter(phase, out.notices); }
    AxisCommand& order(std::size_t axis, AxisCommandKind kind) { return orders.give(axis, kind, term); }
    bool is_order_done(std::size_t axis) const { return orders.is_done(axis, axes); }
    const std::string& name_of_axis(std::size_t axis) const { return machine.axes[axis].name; }
};

}  // namespace lockstep
