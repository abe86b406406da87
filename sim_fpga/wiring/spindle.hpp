// A simulated spindle at a device's output: it comes to its speed with a constant acceleration, and closes an input
// while it has the speed that the output asks for.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/units.hpp"

namespace lockstep {

struct SpindleConfig {
    bool is_analog = false;
    unsigned output = 0;  // of the device's digital outputs, or of its analog ones
    Ticks spin_up;        // from rest to full speed
    unsigned input = 0;   // that is closed while it has its speed
    bool active_low = false;
};

class Spindle {
public:
    /// It has its speed if it is within this part of full speed of it.
    static constexpr double kWithin = 0.02;

    explicit Spindle(const SpindleConfig& config) : config_(config) {}

    const SpindleConfig& config() const { return config_; }

    /// From tick `now` on the output asks for this part of full speed. Calls must not go back in time.
    void drive(double asked, Tick now) {
        speed_ = speed_at(now);
        since_ = now;
        asked_ = asked;
    }
    double speed_at(Tick now) const {
        const double change = ticks_since(now) / static_cast<double>(config_.spin_up.value);
        return asked_ > speed_ ? std::min(asked_, speed_ + change) : std::max(asked_, speed_ - change);
    }
    /// A spindle that is off has no speed.
    bool has_speed(Tick now) const {
        constexpr double kRounding = 1e-9;
        return asked_ > 0 && std::abs(speed_at(now) - asked_) <= kWithin + kRounding;
    }
    /// The first tick after `now` at which it has the speed that it does not have yet; nullopt: there is none.
    std::optional<Tick> next(Tick now) const {
        if (asked_ <= 0 || has_speed(now)) { return std::nullopt; }
        const double missing = std::abs(asked_ - speed_at(now)) - kWithin;
        const double ticks = std::ceil(missing * static_cast<double>(config_.spin_up.value));
        return now + Ticks{std::max<std::int64_t>(1, std::llround(ticks))};
    }

private:
    double ticks_since(Tick now) const { return static_cast<double>((now - since_).value); }

    SpindleConfig config_;
    double asked_ = 0;
    double speed_ = 0;  // at since_
    Tick since_;
};

}  // namespace lockstep
