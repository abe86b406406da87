// Machine time as one process has it: its estimate of the coordinator's clock, made fit to be used. It never goes
// backwards, and while the axis moves it is not set but slewed: it gains or loses kMaxSlew at most until it agrees.
#pragma once

#include "core/clock/clock_estimator.hpp"

namespace lockstep {

class MachineTime {
public:
    static constexpr double kMaxSlew = 500e-6;

    explicit MachineTime(std::int64_t tick_ns) : coordinator_(tick_ns) {}

    /// An exchange with the coordinator.
    void take(const ClockExchange& exchange) { coordinator_.take(exchange); }
    /// The own clock was set forward by so much, which is known within `error`.
    void own_was_set(Ticks by, Ticks error) {
        coordinator_.own_was_set(by, error);
        own_ += by;
    }
    /// Whether the coordinator has answered yet; before that nothing else may be asked.
    bool known() const { return coordinator_.known(); }

    /// The machine time when the own clock reads `own`. `in_use`: it is slewed.
    Tick advance(Tick own, bool in_use);

    /// The same clock read ahead of time, or a little back, and the own clock's reading at a machine time.
    Tick at(Tick own) const;
    Tick own_at(Tick machine) const;

    /// How far `at` may be from the coordinator's clock: what is not slewed yet, and the estimate's bound.
    Ticks error(Tick own) const;

    const ClockEstimator& estimate() const { return coordinator_; }

private:
    double rate() const { return 1 + coordinator_.rate(); }

    ClockEstimator coordinator_;
    bool begun_ = false;
    Tick own_;           // at the last call
    Tick machine_;       // what was shown then
    double beyond_ = 0;  // and the part of a tick, 0 ... 1
};

}  // namespace lockstep
