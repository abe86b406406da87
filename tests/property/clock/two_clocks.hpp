// A clock that differs from the coordinator's, and the network between them. True time is the coordinator's.
#pragma once

#include <cmath>
#include <random>

#include "core/clock/clock_estimator.hpp"

namespace lockstep {

inline constexpr std::int64_t kTick_ns = 1000;

class TwoClocks {
public:
    explicit TwoClocks(std::uint64_t seed) : random_(seed) {
        offset_ = real(-5e6, 5e6);
        drift_ = real(-100e-6, 100e-6);
        delay_least_ = real(20, 400);
        delay_out_ = real(1, 3000);
        delay_back_ = real(1, 3000);
        loss_ = real(0, 0.4);
    }

    Tick own(double truth) const {
        return {static_cast<std::int64_t>(std::floor(offset_ + truth + drift_ * (truth - 1e6)))};
    }
    static Tick coordinator(double truth) { return {static_cast<std::int64_t>(std::floor(truth))}; }
    void step(double ticks) { offset_ += ticks; }

    /// The next exchange that is not lost; true time advances to its arrival.
    ClockExchange exchange() {
        do { truth_ += real(20'000, 100'000); } while (real(0, 1) < loss_);
        ClockExchange result{.sent = own(truth_)};
        double trip = truth_ + delay(delay_out_);
        result.received = coordinator(trip);
        trip += real(0, 300);
        result.answered = coordinator(trip);
        truth_ = trip + delay(delay_back_);
        result.arrived = own(truth_);
        return result;
    }

    double truth() const { return truth_; }
    double drift() const { return drift_; }
    double least_delay() const { return delay_least_; }
    double real(double least, double most) { return std::uniform_real_distribution(least, most)(random_); }

private:
    /// A delay that is mostly short, and sometimes long.
    double delay(double spread) {
        const double x = real(0, 1);
        return delay_least_ + spread * x * x * x;
    }

    std::mt19937_64 random_;
    double truth_ = 1e6;
    double offset_ = 0;
    double drift_ = 0;
    double delay_least_ = 0;
    double delay_out_ = 0;
    double delay_back_ = 0;
    double loss_ = 0;
};

}  // namespace lockstep
