#include "core/coordinator/axes/axis_orders.hpp"

#include <algorithm>

namespace lockstep {

AxisCommand& AxisOrders::give(MotorIndex motor, AxisCommandKind kind, const Term& term) {
    return orders_[motor].emplace(AxisCommand{term, ++sequence_, static_cast<std::uint32_t>(motor), kind});
}

void AxisOrders::withdraw(MotorIndex motor, const AxisRoster& axes) {
    if (!is_open(motor, AxisCommandKind::Reset, axes)) { orders_[motor].reset(); }
}

void AxisOrders::withdraw_all() { std::ranges::fill(orders_, std::nullopt); }

bool AxisOrders::is_done(MotorIndex motor, const AxisRoster& axes) const {
    if (!orders_[motor]) { return true; }
    const auto& state = axes.state(motor);
    return state && state->term == orders_[motor]->term && state->command_done >= orders_[motor]->sequence;
}

bool AxisOrders::all_done(const AxisRoster& axes) const {
    for (const MotorIndex m : motor_indices(orders_.size())) {
        if (!is_done(m, axes)) { return false; }
    }
    return true;
}

bool AxisOrders::is_open(MotorIndex motor, AxisCommandKind kind, const AxisRoster& axes) const {
    return !is_done(motor, axes) && orders_[motor]->kind == kind;
}

void AxisOrders::renew(MotorIndex motor, Tick until, std::vector<AxisCommand>& out) {
    orders_[motor]->until = until;
    out.push_back(*orders_[motor]);
}

void AxisOrders::repeat(const AxisRoster& axes, std::vector<AxisCommand>& out) const {
    for (const MotorIndex m : motor_indices(orders_.size())) {
        if (!is_done(m, axes)) { out.push_back(*orders_[m]); }
    }
}

void AxisOrders::catch_up(const AxisState& state, bool has_open_order) {
    if (state.command_done <= sequence_) { return; }
    sequence_ = state.command_done;
    if (has_open_order) { orders_[state.axis]->sequence = ++sequence_; }
}

}  // namespace lockstep
