// Checks a sequence of steps, step after step, against the limits of its axis.
#pragma once

#include <algorithm>
#include <optional>

namespace lockstep {

/// The mean speed of a wait between two steps is one step divided by the wait, and the axis has that speed at some
/// instant of the wait. So if a motion accelerates by at most a, decelerates by at most d, and jumps by at most the
/// start velocity, the mean speeds of any two waits differ by at most
///   start + a (or d) x the time from the begin of the earlier wait to the end of the later one.
/// Rest before the first wait and after the last one counts as speed 0. A sequence of steps that meets this condition
/// everywhere passes. So a ramp may jump by rounding to whole pulses, counts and clock periods, by at most start.
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

    /// Checks the next step, after a wait in s.
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
    /// Checks the rest after the last step.
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
    double slowest_ = 0;  // the least of the speeds so far, each raised by the acceleration since
    double fastest_ = 0;  // the greatest of them, each lowered by the deceleration since
};

}  // namespace lockstep
