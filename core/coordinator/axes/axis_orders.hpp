// The coordinator's orders to single motors, each repeated until its process reports it as done.
#pragma once

#include <optional>
#include <vector>

#include "core/coordinator/axes/axis_roster.hpp"

namespace lockstep {

class AxisOrders {
public:
    explicit AxisOrders(std::size_t axes) : orders_(axes) {}

    /// Replaces the last order, even if it is open. Returns the new order, so that the caller can set its parameters.
    AxisCommand& give(MotorIndex motor, AxisCommandKind kind, const Term& term);
    /// Call it when the motor's process is gone, because the next one must not carry out its orders. Only an open reset
    /// remains, because it moves nothing and the operator was told that it is accepted.
    void withdraw(MotorIndex motor, const AxisRoster& axes);
    void withdraw_all();
    /// A new owner numbers its orders from the beginning.
    void restart() { sequence_ = 0; }

    /// Also true if no order was given. A process numbers the orders of the owner that it follows, so a state of
    /// another term is no answer to this owner.
    bool is_done(MotorIndex motor, const AxisRoster& axes) const;
    bool all_done(const AxisRoster& axes) const;
    /// An order of this kind is open.
    bool is_open(MotorIndex motor, AxisCommandKind kind, const AxisRoster& axes) const;
    /// The newest order to the motor, done or not.
    const std::optional<AxisCommand>& newest(MotorIndex motor) const { return orders_[motor]; }
    /// Prolongs the newest order to the motor and sends it at once.
    void renew(MotorIndex motor, Tick until, std::vector<AxisCommand>& out);
    void repeat(const AxisRoster& axes, std::vector<AxisCommand>& out) const;

    /// Call it when the motor has carried out an order that was not given here. It takes no order with a lower
    /// number any more, so numbers continue from there.
    void catch_up(const AxisState& state, bool has_open_order);

private:
    std::vector<std::optional<AxisCommand>> orders_;  // the newest to each motor
    std::uint64_t sequence_ = 0;                      // within a term
};

}  // namespace lockstep
