#include "core/coordinator/axes/axis_orders.hpp"

#include <algorithm>

namespace lockstep {

AxisCommand& AxisOrders::give(std::size_t axis, AxisCommandKind kind, const Term& term) {
    return orders_[axis].emplace(AxisCommand{term, ++sequence_, static_cast<std::uint32_t>(axis), kind});
}

void AxisOrders::withdraw(std::size_t axis, const AxisRoster& axes) {
    if (!is_open(axis, AxisCommandKind::Reset, axes)) { orders_[axis].reset(); }
}

void AxisOrders::withdraw_all() { std::ranges::fill(orders_, std::nullopt); }

bool AxisOrders::is_done(std::size_t axis, const AxisRoster& axes) const {
    if (!orders_[axis]) { return true; }
    const auto& state = axes.state(axis);
    return state && state->term == orders_[axis]->term && state->command_done >= orders_[axis]->sequence;
}

bool AxisOrders::all_done(const AxisRoster& axes) const {
    for (std::size_t i = 0; i < orders_.size(); ++i) {
        if (!is_done(i, axes)) { return false; }
    }
    return true;
}

bool AxisOrders::is_open(std::size_t axis, AxisCommandKind kind, const AxisRoster& axes) const {
    return !is_done(axis, axes) && orders_[axis]->kind == kind;
}

void AxisOrders::renew(std::size_t axis, Tick until, std::vector<AxisCommand>& out) {
    orders_[axis]->until = until;
    out.push_back(*orders_[axis]);
}

void AxisOrders::repeat(const AxisRoster& axes, std::vector<AxisCommand>& out) const {
    for (std::size_t i = 0; i < orders_.size(); ++i) {
        if (!is_done(i, axes)) { out.push_back(*orders_[i]); }
    }
}

void AxisOrders::catch_up(const AxisState& state, bool has_open_order) {
    if (state.command_done <= sequence_) { return; }
    sequence_ = state.command_done;
    if (has_open_order) { orders_[state.axis]->sequence = ++sequence_; }
}

}  // namespace lockstep
