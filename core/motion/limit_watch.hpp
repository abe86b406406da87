// Holds a train of steps against the limits of the axis that is to make it, step after step.
#pragma once

#include <algorithm>
#include <optional>

namespace lockstep {

/// The mean speed of a wait is one step over it, and the axis has it at some instant of that wait. So no lawful motion,
/// one that speeds up by at most a, slows down by at most d, and jumps by at most the start velocity, has
///   mean speeds of two waits that differ by more than start + a (or d) x the time from the one's begin to the other's
///   end,
/// rest before the first wait and after the last one included. A train of steps for which that holds everywhere passes:
/// what whole pulses, counts and clock periods make of a smooth ramp may jump too, but never further than one start.
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
        const double gain = limits_.acceleration * wait_s;
        const double loss = limits_.deceleration * wait_s;
        slowest_ += gain;
        fastest_ -= loss;
        const auto breach = compare(speed);
        slowest_ = std::min(slowest_, speed + gain);
        fastest_ = std::max(fastest_, speed - loss);
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
    double slowest_ = 0;  // the least that the speeds so far may all have grown to by now
    double fastest_ = 0;  // the most that they may all have fallen to
};

}  // namespace lockstep
