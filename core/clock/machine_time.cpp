#include "core/clock/machine_time.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lockstep {

Tick MachineTime::advance(Tick own, bool in_use) {
    if (is_own_clock_) { return own_ = machine_ = own; }
    const Tick estimate = coordinator_.at(own).other;
    if (!begun_) {
        begun_ = true;
        own_ = own;
        return machine_ = estimate;
    }
    const double passed = std::max(0.0, static_cast<double>((own - own_).value));
    const double behind = static_cast<double>((estimate - machine_).value) - beyond_;
    const double free = passed * rate();
    const double gained = in_use ? std::clamp(behind, free - passed * kMaxSlew, free + passed * kMaxSlew) : behind;
    const double shown = beyond_ + std::max(0.0, gained);
    machine_ += Ticks{static_cast<std::int64_t>(std::floor(shown))};
    beyond_ = shown - std::floor(shown);
    own_ = own;
    return machine_;
}

Tick MachineTime::at(Tick own) const {
    const double since = static_cast<double>((own - own_).value);
    return machine_ + Ticks{static_cast<std::int64_t>(std::floor(since * rate() + beyond_))};
}

Tick MachineTime::own_at(Tick machine) const {
    const double until = static_cast<double>((machine - machine_).value) - beyond_;
    return own_ + Ticks{static_cast<std::int64_t>(std::llround(until / rate()))};
}

Ticks MachineTime::error(Tick own) const {
    if (is_own_clock_) { return kept_within_; }
    const auto [other, bound] = coordinator_.at(own);
    return {std::abs((other - at(own)).value) + bound.value + 1};
}

}  // namespace lockstep
