// Holds a train of steps against the limits of the axis that is to make it, step after step.
#pragma once

#include <algorithm>
#include <optional>

namespace lockstep::stepgen {

/// The speed at a step is one step over the wait for it. Between any two steps it changes by at most
///   start + acceleration (or deceleration) x the time between them,
/// from rest at the beginning, and to rest at the last step. So every ramp may jump by the start velocity once,
/// wherever and in however many pieces: also what whole pulses, counts and clock periods make of a smooth ramp.
class LimitWatch {
public:
    /// Steps/s, steps/s^2.
    struct Limits {
        double start = 0;
        double acceleration = 0;
        double deceleration = 0;
    };
    struct Breach {
        double change = 0;  // of the speed, steps/s
        double allowed = 0;
    };

    explicit LimitWatch(const Limits& limits) : limits_(limits) {}

    /// The next step, after a wait in s.
    std::optional<Breach> step(double wait_s) {
        const double speed = 1 / wait_s;
        slowest_ += limits_.acceleration * wait_s;
        fastest_ -= limits_.deceleration * wait_s;
        const auto breach = compare(speed);
        slowest_ = std::min(slowest_, speed);
        fastest_ = std::max(fastest_, speed);
        return breach;
    }
    /// After the last one.
    std::optional<Breach> rest() const { return compare(0); }

private:
    std::optional<Breach> compare(double speed) const {
        const double most = limits_.start * (1 + kRounding) + kRounding;
        const double change = std::max(speed - slowest_, fastest_ - speed);
        if (change <= most) { return std::nullopt; }
        return Breach{change, limits_.start};
    }

    static constexpr double kRounding = 1e-6;

    Limits limits_;
    double slowest_ = 0;  // the least that any speed so far may have become by now, at full acceleration
    double fastest_ = 0;  // the most, at full deceleration
};

}  // namespace lockstep::stepgen
