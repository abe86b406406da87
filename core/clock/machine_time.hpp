// Machine time of one process. It is the process's own clock if the time source keeps the clocks of all processes equal
// (Shared, Ptp). Otherwise it is made from the estimate of the coordinator's clock. It then never goes backwards. While
// the axis moves, it is slewed instead of set: it gains or loses at most kMaxSlew until it agrees with the estimate.
#pragma once

#include "core/clock/clock_estimator.hpp"
#include "core/protocol/timing.hpp"

namespace lockstep {

class MachineTime {
public:
    static constexpr double kMaxSlew = 500e-6;

    /// `kept_within`: bound on the error of the own clock if it is machine time.
    MachineTime(std::int64_t tick_ns, TimeSource source, Ticks kept_within = {})
        : is_own_clock_(source != TimeSource::Network), kept_within_(kept_within), coordinator_(tick_ns) {}

    bool is_own_clock() const { return is_own_clock_; }

    /// Takes an exchange with the coordinator.
    void take(const ClockExchange& exchange) { coordinator_.take(exchange); }
    /// The own clock was set forward by `by`, which is known within `error`.
    void own_was_set(Ticks by, Ticks error) {
        coordinator_.own_was_set(by, error);
        own_ += by;
    }
    /// Whether the coordinator has answered yet. Before that no other time may be read.
    bool known() const { return is_own_clock_ || coordinator_.known(); }

    /// Advances to the machine time at which the own clock reads `own`. `in_use`: machine time is slewed, not set.
    Tick advance(Tick own, bool in_use);

    /// Reads machine time a little ahead or back without advancing it, and converts a machine time to the own clock.
    Tick at(Tick own) const;
    Tick own_at(Tick machine) const;

    /// Bound on the error of `at` against the coordinator's clock: the part not slewed yet plus the estimate's bound.
    Ticks error(Tick own) const;

    /// Machine time as the exchanges determine it when the own clock reads `own`, towards which `at` is slewed.
    ClockView estimate(Tick own) const {
        return is_own_clock_ ? ClockView{.own = own, .other = own, .error = kept_within_} : coordinator_.view(own);
    }

private:
    double rate() const { return 1 + coordinator_.rate(); }

    bool is_own_clock_;
    Ticks kept_within_;
    ClockEstimator coordinator_;
    bool begun_ = false;
    Tick own_;           // at the last call
    Tick machine_;       // what was shown at own_
    double beyond_ = 0;  // fraction of a tick beyond machine_, 0 ... 1
};

}  // namespace lockstep
